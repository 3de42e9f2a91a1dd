"""Closed forms of contacts against what they must satisfy: integral equations, limits, tables."""

import numpy as np
import pytest

from postprocess import closed_forms as forms

STEEL = forms.plane_modulus(210e3, 0.3)


def gauss(function, low, high, points=60):
    place, weight = np.polynomial.legendre.leggauss(points)
    half = 0.5 * (high - low)
    return half * np.sum(weight * function(low + half * (place + 1)))


@pytest.mark.parametrize("m", [0, 0.1, 0.5, 0.9, 0.999])
def test_elliptic(m):
    """The elliptic integrals shall be those of their definitions."""
    first, second = forms.elliptic(m)

    def root(t):
        return np.sqrt(1 - m * np.sin(t) ** 2)

    assert first == pytest.approx(gauss(lambda t: 1 / root(t), 0, np.pi / 2, 200), rel=1e-12)
    assert second == pytest.approx(gauss(root, 0, np.pi / 2, 200), rel=1e-12)


def test_ellipse_of_a_sphere():
    """Equal radii shall give Hertz's circle: a^3 = 3 F R/(4 E*), approach a^2/R."""
    a, b, greatest, approach = forms.hertz_ellipse(2000, (10, 10), 1e5)
    assert a == pytest.approx((3 * 2000 * 10 / 4e5) ** (1 / 3), rel=1e-9)
    assert b == pytest.approx(a, rel=1e-7)
    assert (greatest, approach) == pytest.approx((3 * 2000 / (2 * np.pi * a * a), a * a / 10), rel=1e-7)


@pytest.mark.parametrize("ratio", [1.1, 2, 10, 100])
def test_ellipse(ratio):
    """The pressure of a semi-ellipsoid shall bend the half-space to the gap's paraboloid: its potential's integrals."""
    force, radii, modulus = 2000.0, (10.0, 10.0 * ratio), 1e5
    a, b, greatest, approach = forms.hertz_ellipse(force, radii, modulus)
    assert 2 / 3 * np.pi * a * b * greatest == pytest.approx(force, rel=1e-12)

    # uz = p0 a b/(2 E*) int (1 - x^2/(a^2 + w) - y^2/(b^2 + w)) dw/sqrt((a^2 + w)(b^2 + w) w), w = (b t/(1 - t))^2
    def integral(weigh):
        def of(t):
            w = (b * t / (1 - t)) ** 2
            return weigh(w) * 2 * b / (1 - t) ** 2 / np.sqrt((a * a + w) * (b * b + w))

        return greatest * a * b / (2 * modulus) * gauss(of, 0, 1, 400)

    assert integral(lambda w: 1) == pytest.approx(approach, rel=1e-9)
    assert integral(lambda w: 1 / (a * a + w)) == pytest.approx(1 / (2 * max(radii)), rel=1e-7)
    assert integral(lambda w: 1 / (b * b + w)) == pytest.approx(1 / (2 * min(radii)), rel=1e-7)


@pytest.mark.parametrize("half_angle", [0.2, 0.8, 1.2, 1.5])
def test_pin(half_angle):
    """Pin and hole shall close their gap: the Fourier series of a disc's and a hole's radial displacements, summed.

    (2/(pi E')) int p (-2 cos t ln(2 sin(|t|/2)) - 1/2 - cos(t)/2) + dR/R = D cos(theta), t: the difference, any D.
    """

    def of(u, theta, end):
        # both ends of the interval, where p has a root and the kernel a logarithm, smoothed away
        share, slope = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3), 140 * u**3 * (1 - u) ** 3
        t = np.maximum(np.abs(theta - end) * (1 - share), 1e-300)
        kernel = -2 * np.cos(t) * np.log(2 * np.sin(t / 2)) - 0.5 - 0.5 * np.cos(t)
        return forms.pin_pressure(end + (theta - end) * share, half_angle) * kernel * abs(theta - end) * slope

    def closed(theta):
        ends = (-half_angle, half_angle)
        return 2 / np.pi * sum(gauss(lambda u, end=end: of(u, theta, end), 0, 1, 200) for end in ends)

    places = np.array([0, 0.3, 0.6, 0.9]) * half_angle
    left = np.array([closed(theta) for theta in places]) + forms.pin_clearance(half_angle)
    assert left / np.cos(places) == pytest.approx(left[0], rel=1e-9)
    push = gauss(
        lambda u: (
            forms.pin_pressure(half_angle * np.sin(u), half_angle)
            * np.cos(half_angle * np.sin(u))
            * half_angle
            * np.cos(u)
        ),
        -np.pi / 2,
        np.pi / 2,
    )
    assert push == pytest.approx(1, rel=1e-10)
    assert forms.pin_angle(forms.pin_clearance(half_angle)) == pytest.approx(half_angle, rel=1e-9)


def test_loose_pin():
    """A loose pin shall be Hertz's: 1/R = 1/R_pin - 1/R_hole."""
    force, pin, hole = 2000.0, 10.0, 12.0
    angle = forms.pin_angle(STEEL * (hole - pin) / force)
    a, greatest = forms.hertz_line(force, 1 / (1 / pin - 1 / hole), forms.contact_modulus(STEEL, STEEL))
    radius = np.sqrt(pin * hole)
    assert angle * radius == pytest.approx(a, rel=0.01)
    assert forms.pin_pressure(0, angle) * force / radius == pytest.approx(greatest, rel=0.01)


def test_press_fit():
    """A solid shaft in a wide hub of its material shall carry E' d/(2 r); a thin shell what its hoop does."""
    wide = forms.press_fit((1e-6, 1.0, 1e6), 1e-4, (210e3, 0.3), (210e3, 0.3))
    assert wide == pytest.approx(STEEL * 1e-4 / 2, rel=1e-9)
    thin = forms.press_fit((1e-6, 1.0, 1.001), 1e-4, (1e12, 0.3), (210e3, 0.3))
    assert thin == pytest.approx(STEEL * 1e-4 * 0.001, rel=2e-3)
