"""All models on one contact.

Two bearing steels with a boundary film, over four decades of load, computed with every applicable model. `stiction compare
examples/compare_models.toml` prints the same numbers. If a model is outside its range of validity at the working load, its line
is grey. The thick black line is persson_widened, an area model of the prediction (docs/explanation/prediction.md).
"""

import matplotlib.pyplot as plt

import stiction as st

everyone = st.compare_case(st.read_case("examples/compare_models.toml"), load="1 N")

figure, axes = plt.subplots(figsize=(9.5, 5.5), layout="constrained")
order = everyone["friction_coefficient_at_load"].argsort()[::-1]
for at, model in enumerate(everyone["model"].values[order]):
    one = everyone.sel(model=model)
    mu = float(one["friction_coefficient_at_load"])
    main, outside = model == "persson_widened", bool(one["outside_validity"].item())
    pressed = one["load"] > 1e-2
    look = {"color": "0.7"} if outside else {"color": f"C{at % 10}", "linestyle": ("-", "--", ":")[at // 10 % 3]}
    look, width = ({"color": "black"}, 4.0) if main else (look, 1.5)
    axes.loglog(one["load"].where(pressed), one["friction_coefficient"].where(pressed), linewidth=width, **look,
                label=f"{mu:.3f}  {model}{' *' * outside}")  # fmt: skip
axes.axvline(1.0, color="black", linewidth=0.8)
axes.set(xlabel="load [N]", ylabel="static friction coefficient", xlim=(1e-2, 100.0))
axes.grid(alpha=0.3)
figure.legend(loc="outside right upper", fontsize="x-small", title="mu at 1 N; * outside its validity", title_fontsize="small")
figure.savefig("all_models.png", dpi=120)
