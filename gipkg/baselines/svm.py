"""The classifier of the baselines: a linear support vector machine on one vector a shape."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gipkg.learning.prediction import Prediction

REGULARISATION = tuple(10.0**exponent for exponent in range(-3, 4))
"""Values among which cross-validation chooses the constant C."""
FOLDS = 5


def classify(
    vectors: Mapping[str, NDArray[np.float64]],
    train: Mapping[str, str],
    test: Sequence[str],
    *,
    seed: int = 0,
) -> Prediction:
    """Train on some shapes and predict others.

    Features are standardised by the training part, and C is the smallest of the best in a
    stratified cross-validation inside the training part; with one shape in some class there is
    nothing to validate on and C is 1.

    Parameters
    ----------
    vectors : mapping of shape id to (D,) array
        For both parts.
    train : mapping of shape id to class
    test : sequence of shape ids
    seed : int
        Of the folds.

    Returns
    -------
    Prediction
        Scores are the votes of the machines of all pairs of classes, with their confidence;
        embeddings are the vectors as they are, which no training touches.
    """
    from sklearn.model_selection import GridSearchCV, StratifiedKFold
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler
    from sklearn.svm import SVC

    known = np.stack([vectors[i] for i in train])
    targets = np.array(list(train.values()))
    machine = make_pipeline(StandardScaler(), SVC(kernel="linear", decision_function_shape="ovr"))
    folds = min(FOLDS, *Counter(targets.tolist()).values())
    if folds > 1:
        validation = StratifiedKFold(folds, shuffle=True, random_state=seed)
        machine = GridSearchCV(machine, {"svc__C": REGULARISATION}, cv=validation)
    machine.fit(known, targets)
    asked = np.stack([vectors[i] for i in test])
    scores = machine.decision_function(asked)
    if scores.ndim == 1:  # two classes have one plane
        scores = np.stack([-scores, scores], axis=1)
    return Prediction(
        tuple(test),
        tuple(machine.classes_.tolist()),
        scores.astype(np.float32),
        asked.astype(np.float32),
    )
