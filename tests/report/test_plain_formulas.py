"""Formulas of the models as plain text: written by hand here, and none left as LaTeX in terminal and page."""

import pytest
from typer.testing import CliRunner

from stiction import cli
from stiction.report.plain_formulas import as_code, as_text, formula
from stiction.solving.overview import models


@pytest.mark.parametrize(
    ("tex", "plain"),
    [
        (r"\mu=\tau_0/H_s", "μ = τ_0/H_s"),
        (r"\frac{a+b}{c\,d}e^{-g/\rho}", "(a + b)/(c d) e^(-g/ρ)"),
        (r"\tfrac43NE^*R^{1/2}\sigma^{3/2}F_{3/2}", "4/3 NE* R^(1/2) σ^(3/2) F_(3/2)"),
        (r"2\,T_O\!\left(D,\sqrt{\tfrac{1-r}{1+r}}\right)", "2 T_O(D,√((1 - r)/(1 + r)))"),
        (r"\frac4\pi\left[\ln(1+\sqrt2)-\frac{\sqrt2-1}3\right]", "4/π [ln(1 + √2) - (√2 - 1)/3]"),
        (r"\operatorname{erf}\frac p{2\sqrt G}", "erf(p/(2√G))"),
        (r"\left(\frac ab\right)^{0.086}\left(c\right)^2d", "(a/b)^0.086 (c)²d"),
        (r"\bar P(h)=\int_0^\infty P_\text{JKR}(w)\,dw", "P̄(h) = ∫_0^∞ P_JKR(w) dw"),
        (r"10^{-4}\le(2E^{*2}\gamma)^{0.736\nu}", "10⁻⁴ ≤ (2E*²γ)^(0.736ν)"),
        (r"\begin{cases}2w&w<\tau\\0&w\ge\tau\end{cases}", "{ 2w if w < τ; 0 if w ≥ τ }"),
        ("a=b,\\qquad\nc=-d", "a = b,\nc = -d"),
    ],
)
def test_a_formula_is_written_on_a_line(tex, plain):
    assert formula(tex) == plain


@pytest.mark.parametrize("row", models(), ids=lambda row: f"{row['kind']}-{row['key']}")
def test_no_model_is_told_in_latex(row):
    assert "$" in row["text"]
    for said in (as_text(row["text"]), as_code(row["text"]).replace(r"\_", "_")):
        assert not set("$\\") & set(said), [line for line in said.splitlines() if set("$\\") & set(line)]


def test_a_key_keeps_its_underscores_and_a_page_that_is_not_there_is_no_link():
    text = "of [soft_coating_2015] as [theory](../theory.md#8) has $A_n$ in `a_b`, see [the paper](https://doi.org/1)"
    assert as_code(text) == r"of [soft\_coating\_2015] as theory has `A_n` in `a_b`, see [the paper](https://doi.org/1)"
    assert as_text("[`layered`](#layered) with *Assumes*: a_b") == "layered with Assumes: a_b"


def test_the_terminal_shows_no_latex():
    said = " ".join(CliRunner().invoke(cli.app, ["models", "savkoor_briggs_1977"]).output.split())
    assert "P_1 = Ka³/R" in said and "\\" not in said and "$" not in said
