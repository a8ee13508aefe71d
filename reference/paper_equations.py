"""The paper's model in mpmath, straight from the equations, sharing nothing with the package it judges.

Section numbers are those of the derivation this project works from; eq (n) is the paper's own number.
Letters as there: theta, lam(bda), nu, k = H/Y, x apparent and w real displacement, u = x^(1/4).
"""

from itertools import pairwise

import numpy as np
from mpmath import mp, mpf

mp.dps = 34
TOLERANCE = mpf(10) ** -21  # of one panel, relative to the integral of |integrand|
NODES = 32
CLIP = 200  # a piece ends where exp(-z^2/2) has fallen by e^-100 below its largest value on the piece
PARTS = ("load", "abs_load", "area", "slip", "yield", "count")


def exact(value):
    """The double that a reader of the printed number gets, so that both sides start from the same input."""
    return mpf(float(value))


def density(z):
    return mp.exp(-z * z / 2) / mp.sqrt(2 * mp.pi)


def above(z):
    """Q(z): the share of heights above z."""
    return mp.erfc(z / mp.sqrt(2)) / 2


def cubic_root(slope, constant):
    """Positive root of u^3 + slope u = constant, constant > 0, by Newton from above (convex there)."""
    u = mp.cbrt(constant) + (mp.sqrt(-slope) if slope < 0 else 0)
    for _ in range(500):
        step = (u**3 + slope * u - constant) / (3 * u * u + slope)
        u -= step
        if abs(step) < mpf(10) ** -(mp.dps - 2) * u:
            return u
    raise ArithmeticError("no root")


def bisect(function, low, high):
    """The sign change of function between low and high."""
    sign = function(low) > 0
    while high - low > mpf(10) ** -(mp.dps - 3) * abs(high):
        middle = (low + high) / 2
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return (low + high) / 2


class Law:
    """One asperity on a half-space, sections 1 and 2; loads over K R^(1/2) sigma^(3/2)."""

    def __init__(self, theta, lam, nu, k, published=False):
        self.theta, self.lam, self.nu, self.k, self.published = theta, lam, nu, k, published
        self.S = mp.sqrt(6 * mp.pi / theta)  # S theta^(-1/2): P = u^6 - S u^3
        self.s = 2 * self.S / 3  # w = u^4 - s u
        self.eta = mp.sqrt(mp.pi) * mp.root(18 * lam, 4) / mp.sqrt(theta)
        self.K_beta = mpf(8) / 3 * (2 - nu) / (1 - nu)
        self.u0 = mp.cbrt(self.s)  # eq (3): w = 0
        self.u1 = cubic_root(-self.eta, self.S)  # eq (2): mean pressure = H
        self.w1 = self.w(self.u1)  # eq (4)
        self.u_detached = mp.cbrt(self.s / 4)  # dw/du = 0, the end of the unloading branch
        self.u_pull_off = mp.cbrt(self.S / 2)  # P + 3 pi/(2 theta) = (u^3 - S/2)^2 = 0
        self.n = (1 - 2 * nu) / (2 * mp.pi)
        self.p, self.q = 3 * (4 + nu) / 16, 9 * nu / 16
        self.a = self.p**2 + self.q**2 - self.p * self.q
        edge = self.eta / (mp.pi * k * mp.sqrt(3) * self.n)
        # T_yield: real for P < 0 while -P/x <= 2 sqrt(a)/(p+q) edge, positive for P > 0 while P/x < edge
        self.u_branch = cubic_root(2 * mp.sqrt(self.a) / (self.p + self.q) * edge, self.S)
        self.u_zero = cubic_root(-edge, self.S)
        self.found = {}

    def w(self, u):
        return u**4 - self.s * u

    def load(self, u):
        return u**6 - self.S * u**3

    def slip_limited(self, u):
        """Savkoor-Briggs, (2 pi/theta) P + 3 pi^2/theta^2 = (2 pi/theta)(u^3 - S/2)^2; published: eq (10)."""
        t = 2 * mp.pi / self.theta
        if self.published:
            return 4 * mp.sqrt((t * u**6 - 3 * mp.pi**2 / self.theta**2) / self.K_beta)
        return 4 * mp.sqrt(t / self.K_beta) * abs(u**3 - self.S / 2)

    def yield_(self, u):
        """Larger T of 3 n^2 P^2 + 3 n (p-q) P T + a T^2 = (eta x/(pi k))^2; 0 where not real and positive."""
        if not self.u_branch <= u < self.u_zero:
            return mpf(0)
        P = self.load(u)
        right = self.eta * u**4 / (mp.pi * self.k)
        b = 3 * self.n * (self.p - self.q) * P
        c = 3 * self.n**2 * P**2 - right**2
        return (-b + mp.sqrt(max(b * b - 4 * self.a * c, mpf(0)))) / (2 * self.a)

    def friction(self, u):
        return min(self.slip_limited(u), self.yield_(u))

    def plastic_load(self, w):
        return 2 * self.eta * w - 2 * mp.pi / self.theta

    def at(self, w):
        """(P, T, elastic?, slip-limited?) on the loading branch at real displacement w >= 0."""
        if w >= self.w1:
            return self.plastic_load(w), mpf(0), False, False
        u = bisect(lambda v: self.w(v) - w, self.u0, self.u1) if w > 0 else self.u0
        return self.load(u), self.friction(u), True, self.slip_limited(u) <= self.yield_(u)

    def crossings(self, start, end):
        """All u in (start, end) where slip = yield."""
        if (start, end) not in self.found:
            self.found[start, end] = self.find_crossings(max(start, self.u_branch), min(end, self.u_zero))
        return self.found[start, end]

    def find_crossings(self, start, end):
        """Dense scan in doubles, near misses searched for a hidden pair, roots to all digits."""
        if not start < end:
            return []
        cluster = np.logspace(-13, 0, 1500)
        fraction = np.unique(np.concatenate([cluster / 2, 1 - cluster / 2, np.linspace(0, 1, 20001)[1:-1]]))
        gap = self.scan(float(start) + fraction * float(end - start))

        def point(i):
            return start + mpf(fraction[i]) * (end - start)

        found = [
            bisect(self.relative_gap, point(i), point(i + 1))
            for i in np.flatnonzero((gap[1:] > 0) != (gap[:-1] > 0))
            if (self.relative_gap(point(i)) > 0) != (self.relative_gap(point(i + 1)) > 0)
        ]
        size, bend = abs(gap), abs(gap[:-2] - 2 * gap[1:-1] + gap[2:])
        near = (size[1:-1] <= np.minimum(size[:-2], size[2:])) & (size[1:-1] < 4 * bend)
        one_sign = ((gap[:-2] > 0) == (gap[1:-1] > 0)) & ((gap[1:-1] > 0) == (gap[2:] > 0))
        for i in np.flatnonzero(near & one_sign) + 1:
            found += self.close_pair(point(i - 1), point(i), point(i + 1))
        return sorted(found)

    def scan(self, u):
        """relative_gap in doubles, for an array of u from the branch point to the zero of the yield force."""
        P = u**6 - float(self.S) * u**3
        n, p, q, a = (float(v) for v in (self.n, self.p, self.q, self.a))
        edge = float(self.eta) * u**4 / (np.pi * float(self.k))
        b, c = 3 * n * (p - q) * P, 3 * n * n * P * P - edge * edge
        yield_ = (np.sqrt(np.maximum(b * b - 4 * a * c, 0)) - b) / (2 * a)
        t = 2 * np.pi / float(self.theta)
        if self.published:
            slip_limited = 4 * np.sqrt((t * u**6 - 3 * (t / 2) ** 2) / float(self.K_beta))
        else:
            slip_limited = 4 * np.sqrt(t / float(self.K_beta)) * abs(u**3 - float(self.S) / 2)
        return (yield_ - slip_limited) / (yield_ + slip_limited)

    def relative_gap(self, u):
        slip_limited, yield_ = self.slip_limited(u), self.yield_(u)
        return (yield_ - slip_limited) / (yield_ + slip_limited)

    def close_pair(self, left, middle, right):
        """Both crossings hidden in a near miss, by ternary search for the smallest |gap|."""
        sign = 1 if self.relative_gap(middle) > 0 else -1
        low, high = left, right
        for _ in range(100):
            a, b = low + (high - low) / 3, high - (high - low) / 3
            fa, fb = sign * self.relative_gap(a), sign * self.relative_gap(b)
            best = a if fa < fb else b
            if min(fa, fb) < 0:
                return [bisect(self.relative_gap, left, best), bisect(self.relative_gap, best, right)]
            low, high = (low, b) if fa < fb else (a, high)
        return []

    def kinks(self, start, end):
        """Ends and all kinks between, P = 0 included (for the integral of |P|)."""
        kinks = [self.u_pull_off, self.u_branch, self.u_zero, mp.cbrt(self.S), *self.crossings(start, end)]
        return [start, *sorted(u for u in kinks if start < u < end), end]


def legendre_rule(n):
    """Nodes and weights of n-point Gauss-Legendre on (-1, 1), Newton on the Legendre polynomial."""
    rule = []
    for i in range(n):
        x = mp.cos(mp.pi * (i + mpf(3) / 4) / (n + mpf(1) / 2))
        for _ in range(8):
            before, value = mpf(1), x
            for j in range(2, n + 1):
                before, value = value, ((2 * j - 1) * x * value - (j - 1) * before) / j
            slope = n * (x * value - before) / (x * x - 1)
            x -= value / slope
        rule.append((x, 2 / ((1 - x * x) * slope**2)))
    return rule


RULE = legendre_rule(NODES)


def panel(function, a, b):
    half, middle = (b - a) / 2, (a + b) / 2
    total = None
    for x, weight in RULE:
        values = function(middle + half * x)
        terms = [weight * v for v in values]
        total = terms if total is None else [t + v for t, v in zip(total, terms, strict=True)]
    return [half * t for t in total]


def integrate(function, a, b):
    """Integrals of a vector of functions over (a, b): Gauss-Legendre, panels halved until nothing changes."""
    cuts = [a + (b - a) * mpf(i) / 4 for i in range(5)]
    waiting = [(lo, hi, panel(function, lo, hi), 0) for lo, hi in pairwise(cuts)]
    scale = [sum(abs(p[2][j]) for p in waiting) for j in range(len(waiting[0][2]))]
    total = [mpf(0)] * len(scale)
    while waiting:
        lo, hi, whole, depth = waiting.pop()
        middle = (lo + hi) / 2
        left, right = panel(function, lo, middle), panel(function, middle, hi)
        both = [x + y for x, y in zip(left, right, strict=True)]
        if all(abs(x - y) <= TOLERANCE * m for x, y, m in zip(both, whole, scale, strict=True)):
            total = [t + v for t, v in zip(total, both, strict=True)]
        elif depth > 60:
            raise ArithmeticError("quadrature does not converge")
        else:
            waiting += [(lo, middle, left, depth + 1), (middle, hi, right, depth + 1)]
    return total


def elastic(law, h, start, end):
    """PARTS of the elastic asperities from u = start to end, density as in the law's variant (section 3)."""
    total = dict.fromkeys(PARTS, mpf(0))
    if not start < end:
        return total
    height = (lambda u: h + u**4) if law.published else (lambda u: h + law.w(u))
    jacobian = (lambda u: 4 * u**3) if law.published else (lambda u: 4 * u**3 - law.s)
    force_scale = mp.sqrt(2 * mp.pi) if law.published else 1  # eq (12)-(14): exp(..) without 1/sqrt(2 pi)

    def values(u):
        weight = density(height(u)) * jacobian(u)
        P, slip_limited, yield_ = law.load(u) * weight, law.slip_limited(u), law.yield_(u)
        force = min(slip_limited, yield_) * weight * force_scale
        split = (force, mpf(0)) if slip_limited <= yield_ else (mpf(0), force)
        return [P, abs(P), u**4 * weight, *split, weight]

    kinks = law.kinks(start, end)
    for a, b in pairwise(kinks):
        top = mp.sqrt(max(height(a), mpf(0)) ** 2 + CLIP)
        if height(b) > top:
            b = bisect(lambda u, top=top: height(u) - top, a, b)
        if a >= law.u_branch:  # u = u_branch + v^2 takes the square root of the yield force away
            base = law.u_branch

            def mapped(v, base=base):
                return [2 * v * y for y in values(base + v * v)]

            piece = integrate(mapped, mp.sqrt(a - base), mp.sqrt(b - base))
        else:
            piece = integrate(values, a, b)
        for name, value in zip(PARTS, piece, strict=True):
            total[name] += value
    return total


def plastic(law, h, start, end=None):
    """Plastic asperities between w = start and end (None: without end), in closed form."""
    total = dict.fromkeys(PARTS, mpf(0))
    if end is not None and not start < end:
        return total
    sign_change = mp.pi / (law.theta * law.eta)
    cuts = [start, end] if end is None or not start < sign_change < end else [start, sign_change, end]
    if end is None and start < sign_change:
        cuts = [start, sign_change, None]
    with mp.workdps(3 * mp.dps):
        for a, b in pairwise(cuts):
            # Int phi(h+w) dw = Q and Int w phi(h+w) dw = phi - h Q, between the limits
            share, first = above(h + a), density(h + a) - h * above(h + a)
            if b is not None:
                share, first = share - above(h + b), first - (density(h + b) - h * above(h + b))
            P = 2 * law.eta * first - 2 * mp.pi / law.theta * share
            for name, value in (("load", P), ("abs_load", abs(P)), ("area", 2 * first), ("count", share)):
                total[name] += value
    return {name: +value for name, value in total.items()}


def add(*parts):
    return {name: sum(part[name] for part in parts) for name in PARTS}


def bare_parts(law, h):
    """Section 3: (elastic, plastic) asperities of a bare surface."""
    return elastic(law, h, law.u0, law.u1), plastic(law, h, law.w1)


def film_law(law, n_E, n_H):
    """Section 4: the film as a half-space; n_g = 1."""
    return Law(law.theta * n_E, law.lam * n_H**4 / n_E**2, law.nu, law.k, law.published)


def film_parts(film, h, tau):
    """Corrected variant: asperities with w < tau, on the film alone; (elastic, plastic), in film units."""
    if tau < film.w1:
        end = bisect(lambda u: film.w(u) - tau, film.u0, film.u1) if tau > 0 else film.u0
        return elastic(film, h, film.u0, end), plastic(film, h, tau, tau)
    return elastic(film, h, film.u0, film.u1), plastic(film, h, film.w1, tau)


def held_film(film, h, tau):
    """Corrected variant: what the film keeps of its load and resistance where w >= tau, in film units."""
    P, T, _, slips = film.at(tau)
    share = above(h + tau)
    zero = mpf(0)
    force = T * share
    values = P * share, abs(P * share), zero, force if slips else zero, zero if slips else force, share
    return dict(zip(PARTS, values, strict=True))


def times(factor, parts):
    return {name: value if name in ("area", "count") else factor * value for name, value in parts.items()}


def coated_corrected(law, film, h, n_E, tau):
    """Section 4, sequential film: (film parts, held film, substrate parts, film law at the full w)."""
    film_pieces = [times(n_E, part) for part in film_parts(film, h, tau)]
    return film_pieces, times(n_E, held_film(film, h, tau)), bare_parts(law, h + tau), bare_parts(film, h)


def coated_published(law, film, h, tau):
    """Section 4, eq (6) and (15) as printed, empty where limits cross: (load, abs_load, friction)."""
    whole = elastic(film, h, film.u0, film.u1)
    early = whole if film.u1**4 <= tau else elastic(film, h, film.u0, mp.root(tau, 4))
    substrate = elastic(law, h, mp.root(tau + law.u0**4, 4), law.u1)
    loads = [whole, plastic(film, h, film.w1, tau), substrate, plastic(law, h, law.w1)]
    return sum(p["load"] for p in loads), sum(p["abs_load"] for p in loads), force(add(early, substrate))


def force(parts):
    return parts["slip"] + parts["yield"]


def evaluate(formulation, h, theta, lam, nu, k, coating=None):
    """(load, area, friction, abs_load) per asperity; coating = (n_E, n_H, tau) or None. All arguments mpf."""
    law = Law(theta, lam, nu, k, formulation == "published")
    if coating is None:
        total = add(*bare_parts(law, h))
        return total["load"], total["area"], force(total), total["abs_load"]
    n_E, n_H, tau = coating
    film = film_law(law, n_E, n_H)
    if formulation == "published":
        load, absolute, friction = coated_published(law, film, h, tau)
        return load, add(*bare_parts(film, h))["area"], friction, absolute
    pieces, held, substrate, outer = coated_corrected(law, film, h, n_E, tau)
    total = add(*pieces, held, *substrate)
    return total["load"], add(*outer)["area"], force(total), total["abs_load"]
