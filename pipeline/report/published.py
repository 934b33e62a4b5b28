"""What Vasquez Giuliano, Buffo, Vanni and Frungieri (2022), JCIS Open 8, 100068, publish: the one place of their numbers.

Table 2 stands in data/paper_table_2.csv, too; a test compares.
"""

# Rows of Table 2, one granule each. Contacts and coordination of the hollow one: 185 in the first description, 183 in the
# evolution (3.18 = 2 * 183 / 115); of the compact one: coordination before loading (section 3.3).
GRANULES = {
    "hollow": {"title": "Pe → ∞, N = 115", "d_c_nm": 160, "h_c_over_d_c": 0.28, "contacts": 184, "coordination": 3.18},
    "intermediate": {"title": "Pe = 10, N = 102", "d_c_nm": 132, "h_c_over_d_c": 0.43},
    "compact": {"title": "Pe = 1, N = 85", "d_c_nm": 132, "h_c_over_d_c": 0.44, "contacts": 177, "coordination": 4.16},
}

# Section 3.3, one granule each: flow stress that breaks it, Pa, flexible and by the rigid prediction.
BREAKUPS = {"compact": (4040, 4120), "hollow": (2010, 1930)}

# Section 3.4, means of populations: N_max/(6 pi mu gamma_dot a^2) and critical stress in Pa; settled in elongation, largest in shear.
STRENGTH = {"compact": {"settled": (2.89, 4120), "shear": (3.3, 3650)},
            "hollow": {"settled": (6.24, 1930), "shear": (5.1, 2360)}}

# Section 3.5: hours of one run.
DRYING_HOURS = {"hollow": 30, "compact": 240}
BREAKUP_HOURS, BREAKUP_THREADS = 168, 8
RIGID_MINUTES = 5  # "few minutes"
