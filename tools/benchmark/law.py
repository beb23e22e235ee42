"""The law by which an error falls with the number of photons: error^2 = floor^2 + (scale photons^-exponent)^2."""
import numpy


def fit(photons, errors):
    """(exponent, floor) of least squares of the logarithms, the best of a fine grid. The floor, fitted too, is the error that all the
    photons of the world would leave: the mesh's facets, and what the program gets wrong."""
    photons, errors = numpy.asarray(photons, float), numpy.asarray(errors, float)
    best = (numpy.inf,)
    for exponent in numpy.arange(0.02, 1.5, 0.01):
        falling = photons ** -exponent
        falling = (errors[0] / falling[0]) * falling * numpy.geomspace(0.3, 3, 201)[:, None]
        for floor in numpy.linspace(0, 0.999 * errors.min(), 60):
            misfit = numpy.sum(numpy.log(numpy.hypot(floor, falling) / errors) ** 2, axis=1).min()
            if misfit < best[0]:
                best = (misfit, float(exponent), float(floor))
    return best[1:]
