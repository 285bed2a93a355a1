"""Temperature across and along a sheared film of even thickness between two moving half spaces.

The heat equation of the film is solved across it as well as along it: the oil moves with the speed of its own layer, whose
shear rate follows the viscosity at the temperature there, at one shear stress across the film. Temperatures lie on Chebyshev
points across the film. Both surfaces have the rise of Carslaw and Jaeger's moving line of heat (1959, 10.7), integrated by
quadrature. The solver's energy equation has one mean temperature and a parabola across the film instead. SI units.
"""
import math

import numpy as np
from scipy.integrate import quad
from scipy.special import k0e

HALF_WIDTH, FILM, PEAK = 1e-4, 1e-6, 0.6e9
VISCOSITY, PRESSURE_VISCOSITY, FALL = 0.03, 1.5e-8, 0.045        # Barus; exponential fall with temperature
CONDUCTIVITY, CAPACITY = 0.14, 1.74e6                            # oil
STEEL, STEEL_CAPACITY = 46.0, 7850.0 * 460.0
CASES = ((10.0, 1.0), (3.0, 1.0), (10.0, 0.1))                   # mean speed, sliding speed
NODES, LAYERS, ENDS = 121, 7, (-1.5, 1.5)                        # nodes in half widths
PLACES = (-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75)


def pressure(x):
    """Half ellipse over the dry contact."""
    return PEAK * np.sqrt(np.maximum(1 - x**2, 0))


def chebyshev(count):
    """Points from 0 to 1, matrix of the derivative, weights of the integral (Clenshaw and Curtis)."""
    n = count - 1
    points = np.cos(math.pi * np.arange(count) / n)
    ends = np.where((np.arange(count) == 0) | (np.arange(count) == n), 2.0, 1.0) * (-1.0)**np.arange(count)
    apart = points[:, None] - points[None, :] + np.eye(count)
    matrix = np.outer(ends, 1 / ends) / apart
    matrix -= np.diag(matrix.sum(axis=1))
    moments = [(1 + (-1)**k) / (1 - k**2) if k != 1 else 0.0 for k in range(count)]
    weights = np.linalg.solve(np.cos(np.outer(np.arange(count), math.pi * np.arange(count) / n)), moments)
    return (1 - points) / 2, -2 * matrix, weights / 2


def response(x, speed):
    """Rise at each node per heat flux about each other."""
    factor = speed * HALF_WIDTH / (2 * STEEL / STEEL_CAPACITY)
    ends = np.concatenate(([x[0]], (x[1:] + x[:-1]) / 2, [x[-1]]))

    def integral(u):
        """int e^t K_0(|t|) from 0 to u."""
        def integrand(t):
            return k0e(abs(t)) * math.exp(t - abs(t))
        low = max(u, -25.0)
        marks = [mark for mark in (1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0) if mark < abs(low)]
        marks = [0.0, *(math.copysign(mark, u) for mark in marks), low]
        return sum(quad(integrand, a, b, epsabs=0, epsrel=1e-9, limit=200)[0] for a, b in zip(marks, marks[1:]) if a != b)
    step = x[1] - x[0]
    half_steps = np.arange(-2 * len(x), 2 * len(x) + 1)
    table = dict(zip(half_steps.tolist(), [integral(k * step / 2 * factor) for k in half_steps]))
    numbers = np.rint(2 * (x[:, None] - ends[None, :]) / step).astype(int)
    values = np.vectorize(table.get, otypes=[float])(numbers)
    return (values[:, :-1] - values[:, 1:]) * HALF_WIDTH / (math.pi * STEEL * factor)


def temperature(mean_speed, sliding_speed, nodes=NODES, layers=LAYERS):
    """Nodes, mean rise across the film there, rises of both surfaces, heat flux made there."""
    x = np.linspace(*ENDS, nodes)
    step = (x[1] - x[0]) * HALF_WIDTH
    z, slope, weights = chebyshev(layers)
    second = slope @ slope
    walls = [response(x, mean_speed + sign * sliding_speed / 2) for sign in (1, -1)]
    rise = np.zeros((nodes, layers))
    at_rest = VISCOSITY * np.exp(PRESSURE_VISCOSITY * pressure(x))[:, None]
    count, change, part = nodes * layers, 1.0, 0.5
    number = np.arange(count).reshape(nodes, layers)
    while change > 1e-5:
        viscosity = at_rest * np.exp(-FALL * rise)
        stress = sliding_speed / (FILM * (weights / viscosity).sum(axis=1))
        rate = stress[:, None] / viscosity
        slip = np.array([np.linalg.solve(slope[1:, 1:], row[1:] * FILM) for row in rate])
        speed = mean_speed + sliding_speed / 2 - np.hstack([np.zeros((nodes, 1)), slip])
        matrix, side = np.zeros((count, count)), np.zeros(count)
        for i in range(nodes):
            for j in range(1, layers - 1):
                row = number[i, j]
                if i == 0:
                    matrix[row, row] = 1
                    continue
                matrix[row, number[i]] -= CONDUCTIVITY / FILM**2 * second[j]
                before = [1.5, -2.0, 0.5] if i > 1 else [1.0, -1.0]
                for k, weight in enumerate(before):
                    matrix[row, number[i - k, j]] += CAPACITY * speed[i, j] * weight / step
                side[row] = stress[i] * rate[i, j]
            for surface, layer, sign in ((0, 0, 1), (1, layers - 1, -1)):
                row = number[i, layer]
                matrix[row, row] += 1
                for m in range(nodes):
                    matrix[row, number[m]] -= walls[surface][i, m] * sign * CONDUCTIVITY / FILM * slope[layer]
        solved = np.linalg.solve(matrix, side).reshape(nodes, layers)
        change = np.abs(solved - rise).max()
        rise = rise + part * (solved - rise)
    return x, rise @ weights, rise[:, [0, -1]], stress * sliding_speed


def write(path):
    """The table that the tests read."""
    with open(path, 'w', encoding='utf-8') as file:
        file.write('# Temperature of a sheared film of even thickness (test/reference/film_heat_reference.py); the script says which\n'
                   '# inputs. Mean speed, sliding speed, place in half widths; mean rise across the film, rises of both surfaces, heat\n'
                   '# flux made, SI units.\n'
                   'speed,sliding_speed,place,film,first,second,heat\n')
        for mean_speed, sliding_speed in CASES:
            x, film, surfaces, heat = temperature(mean_speed, sliding_speed)
            for place in PLACES:
                i = int(np.argmin(np.abs(x - place)))
                numbers = (mean_speed, sliding_speed, x[i], film[i], *surfaces[i], heat[i])
                file.write(','.join(f'{number:.6e}' for number in numbers) + '\n')
