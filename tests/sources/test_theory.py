"""The theory page is complete, and what it states holds: checked at 30 digits, apart from the package."""

import re
from pathlib import Path

import mpmath as mp
import pytest

PAGES = sorted(
    (Path(__file__).parents[2] / "docs" / "explanation").glob("theory*.md"), key=lambda path: (path.stem != "theory", path.stem)
)
TEXT = "".join(path.read_text(encoding="utf-8") for path in PAGES)
EQUATION = re.compile(r"^\$\$\n(.*?)\n\$\$\n\n(.*?)\n", re.MULTILINE | re.DOTALL)
CASES = [  # theta, lambda, nu, k
    ("0.002", "30", "0.1", "3"),
    ("1", "100", "0.3", "2.8"),
    ("10", "0.125", "0.25", "1.6"),
    ("40", "10", "0.3", "2.8"),
    ("7e5", "4e-3", "0.45", "3.7"),
    ("3e3", "1e6", "0", "2"),
]
STATES = ["0.17", "0.4", "0.51", "0.6667", "0.9", "1.2", "3", "40"]  # y of (S2.7)


@pytest.fixture(autouse=True)
def thirty_digits():
    with mp.workdps(30):
        yield


class Asperity:
    """The letters of sections 1 to 3, for one set of indices."""

    def __init__(self, theta, lam, nu, k):
        self.theta, self.lam, self.nu, self.k = theta, lam, nu, k = tuple(map(mp.mpf, (theta, lam, nu, k)))
        self.S1 = mp.sqrt(6 * mp.pi / theta)  # S'
        self.s = 2 * self.S1 / 3
        self.eta = mp.sqrt(mp.pi) * mp.root(18 * lam, 4) / mp.sqrt(theta)
        self.e = self.eta / mp.cbrt(self.S1**2)
        self.K_beta = mp.mpf(8) / 3 * (2 - nu) / (1 - nu)
        self.g = 4 / mp.sqrt(3 * self.K_beta)
        self.n, self.p, self.q = (1 - 2 * nu) / (2 * mp.pi), 3 * (4 + nu) / 16, 9 * nu / 16
        self.D = self.p**2 + self.q**2 - self.p * self.q

    def load(self, x):
        return x ** mp.mpf("1.5") - self.S1 * x ** mp.mpf("0.75")

    def slip_limited(self, load):
        radicand = 2 * mp.pi / self.theta * load + 3 * mp.pi**2 / self.theta**2
        return 4 / mp.sqrt(self.K_beta) * mp.sqrt(radicand)

    def yield_terms(self, load, x, T):
        """The terms of (S3.7), all on one side."""
        return [
            3 * self.n**2 * load**2,
            3 * self.n * (self.p - self.q) * load * T,
            self.D * T**2,
            -((self.eta * x / (mp.pi * self.k)) ** 2),
        ]


@pytest.fixture(params=CASES, ids="/".join)
def asperity(request):
    return Asperity(*request.param)


def x_of(asperity, y):
    return mp.cbrt(asperity.S1 * mp.mpf(y)) ** 4


def fraction(text):
    """A number written as "2" or "2/3"."""
    return mp.fdiv(*map(int, (text + "/1").split("/")[:2]))


def close(a, b, scale=None):
    return abs(a - b) <= mp.mpf("1e-24") * (scale or max(abs(a), abs(b)))


def test_every_equation_is_numbered_in_order_and_names_its_place_in_the_paper():
    found = EQUATION.findall(TEXT)
    assert TEXT.count("\n$$\n") == 2 * len(found)
    tags = [re.findall(r"\\tag\{(S\d+\.\d+)\}", body) for body, _ in found]
    assert all(len(tag) == 1 for tag in tags)
    tags = [tag[0] for tag in tags]
    counted = {}
    for tag in tags:
        section = tag.split(".")[0]
        counted[section] = counted.get(section, 0) + 1
        assert tag == f"{section}.{counted[section]}"
    assert all(place.startswith("Paper: ") for _, place in found)
    assert set(re.findall(r"\((S\d+\.\d+)\)", TEXT)) <= set(tags), "a reference to no equation"


def test_every_equation_and_every_departure_has_its_row():
    departures, equations = TEXT.split("## 8.")[1].split("## 9.")
    equations = equations.split("## 10.")[0]
    assert re.findall(r"^\| (D\d+) \|", departures, re.MULTILINE) == [f"D{i}" for i in range(1, 13)]
    assert re.findall(r"^\| \((\d+)\) \|", equations, re.MULTILINE) == [str(i) for i in range(1, 16)]


def test_closed_forms_of_the_printed_constants():
    rows = re.findall(r"^\| ([\d.]+) \| \$.*?\$ \| ([\d.]+) \|", TEXT, re.MULTILINE)
    pi = mp.pi
    closed = [
        mp.sqrt(6 * pi),
        mp.sqrt(8 * pi / 3),
        mp.cbrt(8 * pi / 3) ** 2,
        pi * mp.root(18 / pi**2, 4),
        2 * pi * mp.root(18 / pi**2, 4),
        2 * pi,
        3 * pi**2,
    ]
    assert len(rows) == len(closed)
    for (printed, value), exact in zip(rows, closed, strict=True):
        assert abs(mp.mpf(printed) - exact) <= mp.mpf("0.006")
        assert value == mp.nstr(exact, len(value) - 1, strip_zeros=False)


def test_scaled_elastic_law(asperity):
    for y in map(mp.mpf, STATES):
        x = x_of(asperity, y)
        assert close(asperity.load(x), asperity.S1**2 * y * (y - 1))
        w = x - asperity.s * mp.root(x, 4)
        scaled = mp.cbrt(asperity.S1) ** 4 * (mp.cbrt(y) ** 4 - 2 * mp.cbrt(y) / 3)
        assert close(w, scaled, scale=x)


def test_jump_at_yield(asperity):
    v = mp.findroot(lambda v: v**3 - asperity.e * v - 1, 1.5 + mp.sqrt(asperity.e))
    y = v**3
    x = x_of(asperity, y)
    w = x - asperity.s * mp.root(x, 4)
    plastic = 2 * asperity.eta * w - 2 * mp.pi / asperity.theta
    assert close(asperity.load(x), asperity.eta * x)
    assert close(plastic / asperity.load(x), 2 - (4 * y - 3) / (3 * y * (y - 1)), scale=1 / (y - 1))
    assert close(2 * w / x, 2 - 4 / (3 * y))


@pytest.mark.parametrize(
    ("theta", "lam", "jump"), [("10", "0.125", 0.890), ("10", "1", 1.276), ("10", "10", 1.585), ("1", "100", 1.870)]
)
def test_jump_at_yield_in_numbers(theta, lam, jump):
    e = Asperity(theta, lam, "0.3", "2.8").e
    y = mp.findroot(lambda v: v**3 - e * v - 1, 1.5 + mp.sqrt(e)) ** 3
    assert abs(2 - (4 * y - 3) / (3 * y * (y - 1)) - jump) < 6e-4


def test_slip_force_is_linear_along_the_elastic_branch(asperity):
    for y in map(mp.mpf, STATES):
        x = x_of(asperity, y)
        slip_limited = asperity.slip_limited(asperity.load(x))
        in_u = (
            4
            / mp.sqrt(asperity.K_beta)
            * mp.sqrt(2 * mp.pi / asperity.theta)
            * abs(mp.root(x, 4) ** 3 - mp.sqrt(6 * mp.pi / asperity.theta) / 2)
        )
        assert close(slip_limited, in_u)
        assert close(slip_limited, asperity.g * asperity.S1**2 * abs(y - 0.5))


def test_printed_slip_force_is_the_peeled_state(asperity):
    for load in map(mp.mpf, ("0.1", "1", "25")):
        peeled = load + 3 * mp.pi / asperity.theta  # x^(3/2) of the peeled state
        printed = 4 / mp.sqrt(asperity.K_beta) * mp.sqrt(2 * mp.pi / asperity.theta * peeled - 3 * mp.pi**2 / asperity.theta**2)
        y = peeled / asperity.S1**2  # square of y
        assert close(printed, asperity.slip_limited(load))
        assert close(printed, asperity.g * asperity.S1**2 * mp.sqrt(y - 0.25))


@pytest.mark.parametrize(("ratio", "expected"), [("-0.5", 1.28338), ("0", 1.81497), ("2", 3.14362), ("10", 6.01958)])
def test_slip_force_over_pull_off(ratio, expected):
    asperity = Asperity("3", "1", "0.3", "2.8")
    pull_off = 3 * mp.pi / (2 * asperity.theta)
    assert abs(asperity.slip_limited(mp.mpf(ratio) * pull_off) / pull_off - expected) < 5.1e-6


def test_yield_condition_has_the_seven_powers_of_eq_11(asperity):
    nu, k, S1, theta = asperity.nu, asperity.k, asperity.S1, asperity.theta
    c1 = 1.5 * (1 - 2 * nu) ** 2
    c5 = 9 * mp.pi / 4 * (1 - 2 * nu) * (1 - nu / 2)
    c7 = 9 * mp.pi**2 / 16 * (2 - nu / 2 + 7 * nu**2 / 8)
    c3 = -6 * mp.pi * mp.sqrt(2) / k**2 * mp.sqrt(asperity.lam) / theta
    for y in map(mp.mpf, STATES):
        x = x_of(asperity, y)
        X = mp.root(x, 4) ** 3
        T = asperity.slip_limited(asperity.load(x))
        eq11 = c1 * x**3 - 2 * S1 * c1 * X**3 + c3 * x**2 + (S1**2 * c1 + c5 * T) * X**2 - S1 * c5 * T * X + c7 * T**2
        terms = [2 * mp.pi**2 * term for term in asperity.yield_terms(asperity.load(x), x, T)]
        assert close(eq11, sum(terms), scale=sum(map(abs, terms)) + c1 * x**3)


def test_reconstructed_coefficients_in_numbers():
    rows = re.findall(r"^\| \$(C_\d)\$ \| .*? \| \$?(-?[\d.]+)", TEXT, re.MULTILINE)
    nu, k, S = mp.mpf("0.3"), mp.mpf("2.8"), mp.sqrt(6 * mp.pi)
    c1, c5 = 1.5 * (1 - 2 * nu) ** 2, 9 * mp.pi / 4 * (1 - 2 * nu) * (1 - nu / 2)
    exact = [
        c1,
        -2 * S * c1,
        -6 * mp.pi * mp.sqrt(2) / k**2,
        S**2 * c1,
        c5,
        -S * c5,
        9 * mp.pi**2 / 16 * (2 - nu / 2 + 7 * nu**2 / 8),
    ]
    assert [name for name, _ in rows] == [f"C_{i}" for i in range(1, 8)]
    for (_, number), value in zip(rows, exact, strict=True):
        assert abs(mp.mpf(number) - value) < 5.1e-6


def test_slip_equals_yield_is_one_function_of_y(asperity):
    n, p, q, g = asperity.n, asperity.p, asperity.q, asperity.g
    for y in map(mp.mpf, STATES):
        x = x_of(asperity, y)
        load = asperity.load(x)
        terms = asperity.yield_terms(load, x, asperity.slip_limited(load))
        m = abs(y - 0.5)
        reduced = (
            asperity.D * g**2 * m**2
            + 3 * n * (p - q) * g * y * (y - 1) * m
            + 3 * n**2 * y**2 * (y - 1) ** 2
            - (asperity.e / (mp.pi * asperity.k)) ** 2 * mp.cbrt(y) ** 8
        )
        assert close(sum(terms), asperity.S1**4 * reduced, scale=sum(map(abs, terms)))


def test_ends_of_the_yield_force(asperity):
    n, p, q, D, k = asperity.n, asperity.p, asperity.q, asperity.D, asperity.k
    K0 = 1 / (mp.sqrt(3) * mp.pi * k * n)
    K1 = 2 * mp.sqrt(D) * K0 / (p + q)
    u = mp.findroot(lambda u: u**3 + K1 * asperity.eta * u - asperity.S1, (mp.mpf(0), mp.cbrt(asperity.S1)), solver="anderson")
    load_squared, mixed, _, limit = asperity.yield_terms(asperity.load(u**4), u**4, mp.mpf(1))
    assert close(mixed**2, 4 * D * (load_squared + limit), scale=4 * D * load_squared)  # discriminant zero
    u = mp.findroot(lambda u: u**3 - K0 * asperity.eta * u - asperity.S1, mp.cbrt(asperity.S1) + mp.sqrt(K0 * asperity.eta))
    load_squared, _, _, limit = asperity.yield_terms(asperity.load(u**4), u**4, mp.mpf(0))
    assert close(load_squared, -limit, scale=load_squared + 3 * n**2 * u**12)  # the load alone yields
    assert (K0 < 1) == ((1 - 2 * asperity.nu) * k > 2 / mp.sqrt(3))


def test_landmarks_of_the_elastic_law():
    rows = re.findall(r"^\| ([\d/]+) \| [a-z][^|]* \| ([^|]+) \| ([^|]+) \| ([^|]+) \|", TEXT, re.MULTILINE)
    assert len(rows) == 4
    asperity = Asperity("1", "1", "0.3", "2.8")
    for row in rows:
        y, ratio, w, x = (part.strip().replace("−", "-") for part in row)
        exact = x_of(asperity, fraction(y))
        assert close(asperity.load(exact) / (3 * mp.pi / 2), fraction(ratio), scale=mp.mpf(1))
        assert abs(exact - mp.mpf(x)) < 5.1e-6
        assert abs(exact - asperity.s * mp.root(exact, 4) - mp.mpf(w)) < 5.1e-6


def test_plastic_sum_is_closed():
    with mp.workdps(20):
        for h, w1 in ((mp.mpf("-1.3"), mp.mpf("0.4")), (mp.mpf(2), mp.mpf("1.5"))):
            z1 = h + w1
            closed = mp.npdf(z1) - h * mp.erfc(z1 / mp.sqrt(2)) / 2
            assert abs(mp.quad(lambda w, h=h: w * mp.npdf(h + w), [w1, w1 + 4, w1 + 14]) / closed - 1) < 1e-15


def test_exponential_heights_without_adhesion():
    with mp.workdps(20):
        eta, h = mp.mpf("0.8"), mp.mpf("0.5")
        elastic = mp.quad(lambda w: w ** mp.mpf("1.5") * mp.exp(-(h + w + 1)), [0, eta**2])
        plastic = mp.quad(lambda w: 2 * eta * w * mp.exp(-(h + w + 1)), [eta**2, 5, 60])
        closed = mp.gammainc(mp.mpf("2.5"), 0, eta**2) + 2 * eta * (1 + eta**2) * mp.exp(-(eta**2))
        assert abs((elastic + plastic) / (closed * mp.exp(-(h + 1))) - 1) < 1e-15
