"""What a baseline's accuracy is when nobody chooses its scaling and its constant.

    python -m benchmarks.untuned_svm RESULTS DATABASE zernike lfd [--constants .01 1 100]

RESULTS is the folder of a run that has these baselines. For each of their rows in Table 1: the
mean accuracy over the run's splits of a linear support vector machine on the vectors as they
come, and on standardised ones, with each constant C. The table itself standardises and
cross-validates C inside the training part; of either the paper says nothing.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from sklearn.pipeline import Pipeline, make_pipeline
from sklearn.preprocessing import FunctionTransformer, StandardScaler
from sklearn.svm import SVC

from gipkg.files import read_csv
from gipkg.shards import Shard

SCALINGS = {"as they come": FunctionTransformer, "standardised": StandardScaler}


def main() -> None:
    """Print one row for each baseline, row of the table and scaling."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("database")
    parser.add_argument("baselines", nargs="+")
    parser.add_argument("--constants", type=float, nargs="+", default=[0.01, 1, 100])
    options = parser.parse_args()
    print(f"| baseline | row | vectors | {' | '.join(f'C = {c:g}' for c in options.constants)} |")
    print("|---|---|---|" + "---|" * len(options.constants))
    for baseline in options.baselines:
        vectors = represented(options.results / "baselines" / options.database / baseline)
        found: dict[tuple[str, str], list[list[float]]] = defaultdict(list)
        for row, train, test in splits(options.results / "datasets" / options.database):
            for scaling, scaler in SCALINGS.items():
                machines = [
                    make_pipeline(scaler(), SVC(kernel="linear", C=c)) for c in options.constants
                ]
                scores = [accuracy(machine, vectors, train, test) for machine in machines]
                found[row, scaling].append(scores)
        for (row, scaling), scores in found.items():
            means = " | ".join(f"{mean:.1f}" for mean in 100 * np.mean(scores, axis=0))
            print(f"| {baseline} | {row} | {scaling} | {means} |", flush=True)


def represented(folder: Path) -> dict[str, NDArray[np.float64]]:
    """Return the vectors that a baseline has made, by shape."""
    shards = [Shard.open(path) for path in sorted(folder.glob("*.npz")) if path.stem.isdigit()]
    return {
        shape: arrays["representation"].ravel()
        for shard in shards
        for shape, arrays in shard.items()
    }


def splits(folder: Path) -> Iterator[tuple[str, dict[str, str], dict[str, str]]]:
    """Yield the splits of a run: row, and shape -> class of both parts."""
    for path in sorted((folder / "splits").glob("*.csv")):
        lines = read_csv(path)
        train, test = (
            {line["id"]: line["label"] for line in lines if line["part"] == part}
            for part in ("train", "test")
        )
        yield path.stem.rpartition("-")[0], train, test


def accuracy(
    machine: Pipeline,
    vectors: dict[str, NDArray[np.float64]],
    train: dict[str, str],
    test: dict[str, str],
) -> float:
    """Train on one part and return the share of the other that is predicted right."""
    machine.fit([vectors[shape] for shape in train], list(train.values()))
    return float(machine.score([vectors[shape] for shape in test], list(test.values())))


if __name__ == "__main__":
    main()
