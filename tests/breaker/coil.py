"""A coiled chain of touching spheres: it turns into the flow, straightens and breaks."""
import math

import numpy


def coil(count):
    """Centres in nm of spheres of radius 100 nm."""
    turn = [[250 * math.cos(0.75 * k), 60 * k, 250 * math.sin(0.75 * k)] for k in range(count)]
    centres = [numpy.array(turn[0])]
    for k in range(1, count):
        step = numpy.array(turn[k]) - numpy.array(turn[k - 1])
        centres.append(centres[-1] + 200 * step / numpy.linalg.norm(step))
    return centres
