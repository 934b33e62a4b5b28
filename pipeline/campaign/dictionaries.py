"""Breakup sections for two population-balance codes, with the range and the misfit of what stands in them.

OpenFOAM, populationBalance (Foundation, version 9 and later): breakupModels Kusters, keys B, dP, kc, Df:
    rate = sqrt(4/(15 pi)) sqrt(epsilon/nu) exp(-epsilon_cr/epsilon),  epsilon_cr = B/R_c,  R_c = (dP/2) (n/kc)^(1/Df),  n = (d/dP)^Df
(Kusters 1991). Since <2 E:E> = epsilon/nu, sigma_cr = sqrt(mu rho epsilon_cr), so B = R_c sigma_cr^2/(mu rho): the form holds where sigma_cr goes as R_c^-1/2.

OpenQBMM: breakupKernel LuoSvendsen, keys Cb, epsilonExp, nuExp, sizeExp:
    rate = Cb epsilon^epsilonExp nu^nuExp L^sizeExp
With sigma_cr = C R^-p and rate = K (sigma_rms/sigma_cr)^q sqrt(epsilon/nu), sigma_rms = rho sqrt(epsilon nu) and L = 2 R:
    Cb = K (rho/C)^q 2^(-p q), epsilonExp = (q + 1)/2, nuExp = (q - 1)/2, sizeExp = p q.
"""

import dataclasses
import math


class Refusal(Exception):
    """Why the data do not bear this section."""


@dataclasses.dataclass
class Liquid:
    viscosity: float  # Pa s
    density: float    # kg/m^3


@dataclasses.dataclass
class Kusters:
    B: float          # m^3/s^3
    dP: float         # m
    kc: float
    Df: float
    low: float        # of B, 95 %
    high: float
    misfit: float     # largest of a class, of sigma_cr, relative


@dataclasses.dataclass
class PowerKernel:
    Cb: float         # SI
    epsilon: float
    nu: float
    size: float


def kusters(law, classes, radius, liquid):
    """law: SizeLaw of sigma_cr over R_c; classes: [(R_c of each, sigma_cr of each, N of each)]; radius of primary particles, m."""
    low, high = law.exponent_interval
    if not low <= 0.5 <= high:
        raise Refusal(f"sigma_cr goes as R^-{law.exponent:.3g} ({low:.3g} to {high:.3g}); Kusters has R^-0.5 and would be wrong where sizes differ")
    logs = [(sum(math.log(r * s * s / (liquid.viscosity * liquid.density)) for r, s in zip(rs, ss)) / len(ss), rs, ss) for rs, ss, _ in classes]
    middle = sum(one for one, _, _ in logs) / len(logs)
    error = [math.sqrt(sum((math.log(r * s * s / (liquid.viscosity * liquid.density)) - one) ** 2 for r, s in zip(rs, ss)) / (len(ss) - 1) / len(ss)) for one, rs, ss in logs]
    half = 1.96 * math.sqrt(sum(e * e for e in error)) / len(error)
    # n = kc (R_c/a)^Df over the classes.
    x = [sum(math.log(r / radius) for r in rs) / len(rs) for rs, _, _ in classes]
    y = [sum(math.log(n) for n in ns) / len(ns) for _, _, ns in classes]
    xm, ym = sum(x) / len(x), sum(y) / len(y)
    Df = sum((a - xm) * (b - ym) for a, b in zip(x, y)) / sum((a - xm) ** 2 for a in x)
    return Kusters(math.exp(middle), 2 * radius, math.exp(ym - Df * xm), Df, math.exp(middle - half), math.exp(middle + half),
                   max(abs(math.expm1(0.5 * (one - middle))) for one, _, _ in logs))


def power_kernel(law, rate, liquid):
    """law: SizeLaw; rate: rate.PowerLaw."""
    q, p = rate.exponent, law.exponent
    return PowerKernel(rate.factor * (liquid.density / law.factor) ** q * 2 ** (-p * q), 0.5 * (q + 1), 0.5 * (q - 1), p * q)


def commented(lines):
    return "".join(f"// {line}\n" for line in lines)


def openfoam(found, words):
    return commented(words) + f"""breakupModels
(
    Kusters
    {{
        B               {found.B:.6g};    // m3/s3, 95 %: {found.low:.4g} to {found.high:.4g}
        dP              {found.dP:.6g};    // m
        kc              {found.kc:.6g};
        Df              {found.Df:.6g};

        daughterSizeDistributionModel uniformBinary;
    }}
);
"""


def openqbmm(found, daughters, words):
    """Units of Cb such that the rate is in 1/s: m^-(2 a + 2 b + c) s^(3 a + b - 1)."""
    metres = -(2 * found.epsilon + 2 * found.nu + found.size)
    seconds = 3 * found.epsilon + found.nu - 1
    return commented(words) + f"""breakupKernel
{{
    breakupKernel   LuoSvendsen;
    Cb              Cb [0 {metres:.6g} {seconds:.6g} 0 0 0 0] {found.Cb:.9g};
    epsilonExp      {found.epsilon:.9g};
    nuExp           {found.nu:.9g};
    sizeExp         {found.size:.9g};

    daughterDistribution
    {{
        daughterDistribution {daughters};
    }}
}}
"""
