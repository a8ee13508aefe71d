"""Score predictions against the contacts of contacts.csv.

python validation/contacts/score.py     # a line for each contact, and how often the intervals hold the printed friction

A printed range counts by its geometric mean; a kinetic coefficient may be a third below the static one. The interface of each
contact is stated, its roughness is that of the finish classes.
"""

import contacts
import numpy as np

import stiction as st

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
KINETIC = 1.33  # the static coefficient at most, over the kinetic one


def score(row: dict[str, str]) -> tuple[float, float, np.ndarray, float]:
    """Return the printed range, the predicted quantiles at LEVELS, and the share of draws below the printed mean."""
    contact = contacts.contact_of(row, interface=row["interface"])
    answer = st.predict(contact, load=float(row["load_N"]))
    mu = answer.friction_coefficient_samples.values
    low, high = float(row["mu_low"]), float(row["mu_high"])
    high *= KINETIC if row["which"] == "kinetic" else 1.0
    return low, high, np.nanquantile(mu, LEVELS), float(np.mean(mu < (low * high) ** 0.5))


def main() -> None:
    shares, widths, overlaps = [], [], []
    for row in contacts.rows():
        if row["in_scope"] != "yes":
            continue
        low, high, predicted, share = score(row)
        shares.append(share)
        widths.append(predicted[-1] / predicted[0])
        overlaps.append(low <= predicted[-1] and high >= predicted[0])
        ends = " ".join(f"{value:8.3g}" for value in predicted)
        print(f"{row['interface']:18} {row['id']:26} printed {low:6.3g} to {high:6.3g}  predicted {ends}")
    found = np.array(shares)
    for name, low, high in (("50 %", 0.25, 0.75), ("90 %", 0.05, 0.95)):
        print(f"{name} interval holds {np.mean((found >= low) & (found <= high)):.0%} of {len(found)} contacts")
    print(f"printed range overlaps the 90 % interval: {np.mean(overlaps):.0%}")
    middle, narrow = np.median(widths), np.mean(np.less(widths, 10))
    print(f"width of the 90 % interval: a factor {middle:.2g} in the median, below 10 in {narrow:.0%}")


if __name__ == "__main__":
    main()
