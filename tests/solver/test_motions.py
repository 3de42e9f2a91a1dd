"""solver/problem/rigid-modes.idp, laws by contact: a problem of random matrices, against its conditions."""

import numpy as np
import pytest
from freefem import cases_of, data, snippet, told

BEGIN = data("motions/begin.edp")

MOTIONS = data("motions/motions.edp")

END = data("motions/end.edp")


class Problem:
    """Half-plane contacts side by side, coupled by a random smooth compliance; `motions` of them free."""

    def __init__(self, seed, sizes=(40, 40), motions=2, stiff=0):
        rng = np.random.default_rng(seed)
        n = sum(sizes)
        self.contact = np.repeat(np.arange(len(sizes)), sizes)
        x = np.concatenate([np.linspace(-1, 1, m) + 0.01 * rng.standard_normal(m) for m in sizes])
        x = np.concatenate([np.sort(x[self.contact == c]) for c in range(len(sizes))])
        self.x = x + 10 * self.contact
        self.weight = np.concatenate([np.gradient(x[self.contact == c]) for c in range(len(sizes))])
        same = self.contact[:, None] == self.contact[None, :]
        apart = np.abs(x[:, None] - x[None, :])
        np.fill_diagonal(apart, self.weight / 2 / np.e)
        smooth = np.stack([f(x) * (1 + self.contact) for f in (np.ones_like, np.sin, np.cos, lambda t: t)], axis=1)
        self.C = np.where(same, np.log(20 / apart), 0) + 0.3 * smooth @ np.diag(rng.uniform(0.1, 1, 4)) @ smooth.T
        self.C += (1e-3 - min(np.linalg.eigvalsh(self.C)[0], 0)) * np.eye(n)
        self.gap = 0.02 * (2 * x**2 + 0.1 * rng.standard_normal(len(sizes))[self.contact])
        self.G = np.stack([1 + 0 * x, x, 1.0 * (self.contact == 0), x * self.contact], axis=1)[:, :motions]
        L = rng.standard_normal((motions, motions))
        self.S = stiff * (L @ L.T)
        q = np.where(np.abs(x) < 0.5, self.weight * rng.uniform(0.5, 1.5, n), 0) * 0.01
        self.t = self.G.T @ q
        self.motions = motions

    def write(self, folder):
        data = dict(
            pointX=self.x, weight=self.weight, initialOverlap=-self.gap, contactOf=self.contact,
            K=np.linalg.inv(self.C),
            field=np.vstack([self.G, np.abs(self.G).max(axis=0) < 1e-6]), modeFullWork=self.t, modeStiffness=self.S,
        )  # fmt: skip
        for name, values in data.items():
            values = np.ravel(values)
            (folder / name).write_text(
                "\n".join(map(repr, map(float, [len(values), *values]))).replace(".0\n", "\n", 1) + "\n"
            )

    def solve(self, folder, *flags, laws="", expect=0):
        self.write(folder)
        text = BEGIN.replace("CONTACTS", str(self.contact[-1] + 1)) + laws
        if self.motions:
            text += MOTIONS.replace("MOTIONS", str(self.motions))
        return snippet(folder, text + END, *flags, "-out", folder / "out", expect=expect)

    def check(self, values, pressure):
        """pressure(contact, s): p where a law holds, None for hard contact."""
        q, s = values["q"], values["overlap"]
        alpha = values["motion"] if self.motions else np.zeros(0)
        free = -self.gap - pressure_start(pressure, self.contact)
        np.testing.assert_allclose(s, free - self.C @ q + self.G @ alpha, atol=1e-9 * abs(free).max())
        if self.motions:
            off = self.G.T @ q + self.S @ alpha - self.t
            assert abs(off).max() < 1e-9 * abs(self.t).max()
        scale = np.abs(q).max()
        for c in np.unique(self.contact):
            at = self.contact == c
            law = pressure[c]
            if law is None:
                assert (q[at] > -1e-6 * scale).all()
                assert (s[at] < 1e-6 * abs(self.gap).max()).all()
                assert (abs(s[at][q[at] > 1e-4 * scale]) < 1e-5 * abs(self.gap).max()).all()
            else:
                np.testing.assert_allclose(q[at], self.weight[at] * law[0](s[at]), atol=1e-5 * scale)


def pressure_start(pressure, contact):
    return np.array([0 if law is None else law[1] for law in pressure])[contact]


def power(kappa, m, d0):
    return lambda s: kappa * np.maximum(s, 0) ** m, d0


PLAIN = ["-start", "none", "-preconditioner", "diagonal"]


@pytest.mark.parametrize(
    "flags, motions, stiff",
    cases_of([([], 0, 0), ([], 4, 1), (PLAIN, 2, 1)], [([], 2, 0), (PLAIN, 1, 0), (PLAIN, 4, 0)]),
)
def test_hard_contact(tmp_path, flags, motions, stiff):
    """Forces, overlaps and motions shall fulfil the conditions of hard contact and balance the loads."""
    problem = Problem(1, motions=motions, stiff=stiff)
    if motions == 0:
        problem.gap -= 0.02
    values = told(problem.solve(tmp_path, *flags))
    assert values["converged"] == 1
    problem.check(values, [None, None])


LAWS = """
real[int] first = [1e5, 3, 1, 1, -0.004];
real[int] second = [1, 2, 0.02, 800, -0.003];
"""


def test_laws_by_contact(tmp_path):
    """Each contact shall follow its own law."""
    problem = Problem(2, sizes=(30, 30, 30), motions=2)
    laws = LAWS + 'setContactLaw(0, "a", "power", first, "");\nsetContactLaw(1, "b", "exponential", second, "");\n'
    values = told(problem.solve(tmp_path, laws=laws))
    assert values["converged"] == 1
    exponential = (lambda s: 0.02 * np.expm1(800 * np.maximum(s, 0)), -0.003)
    problem.check(values, [power(1e5, 3, -0.004), exponential, None])


def test_unfelt_motion(tmp_path):
    """A motion that no gap feels shall be fixed, or refused by name if a load works on it."""
    problem = Problem(1, motions=3)
    problem.G[:, 2] = 1e-14 * problem.x
    problem.t[2] = 0
    values = told(problem.solve(tmp_path))
    assert values["converged"] == 1
    assert list(values["fixed"]) == [0, 0, 1]
    problem.check(values, [None, None])
    problem.t[2] = problem.t[0]
    assert problem.solve(tmp_path, expect=10).splitlines()[-1].startswith("motion 2: a load works on it")


def test_load_away_from_the_contact(tmp_path):
    """A load that contact cannot push against shall be refused by name: there is no equilibrium."""
    problem = Problem(1, motions=1)
    problem.t *= -1
    said = problem.solve(tmp_path, expect=10).splitlines()[-1]
    assert said.startswith("motion 0: a load works on it, but no contact can push")


@pytest.mark.parametrize("seed", [7, 8])
def test_kernel_saves_products(tmp_path, seed):
    """The kernel of each contact shall need half the diagonal's products, with motions too."""
    problem = Problem(seed, sizes=(60, 60), motions=4)
    kernel = told(problem.solve(tmp_path))
    diagonal = told(problem.solve(tmp_path, "-preconditioner", "diagonal"))
    np.testing.assert_allclose(kernel["q"], diagonal["q"], atol=1e-5 * kernel["q"].max())
    assert 2 * kernel["backsolves"] < diagonal["backsolves"]
