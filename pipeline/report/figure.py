"""What all figures share: the same bytes every time, colours that all eyes tell apart, files that are whole or absent."""

import matplotlib

import whole

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "crumble", "svg.fonttype": "none", "font.size": 9})
from matplotlib import pyplot  # noqa: E402

# Okabe & Ito (2008); dashes tell lines apart in print, too.
BLACK, ORANGE, BLUE, GREEN, PURPLE = "#222222", "#D55E00", "#0072B2", "#009E73", "#CC79A7"
LINES = [(BLACK, "-"), (ORANGE, "--"), (BLUE, "-."), (GREEN, ":"), (PURPLE, (0, (5, 1, 1, 1, 1, 1)))]


def save(figure, out):
    with whole.replacing(out) as temporary:
        figure.savefig(temporary, format="svg", metadata={"Date": None})
    pyplot.close(figure)
