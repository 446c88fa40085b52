"""Geometry images to class scores and shape signatures (paper, Section 4.2 and 5).

One call trains a network on the training part of a split and predicts its test part::

    from gipkg.learning.config import NetworkConfig, TrainingConfig
    from gipkg.learning.experiment import train_and_predict

    prediction = train_and_predict(
        images,                 # mapping: shape id -> (views, C, n, n) float32, unpadded
        labels,                 # mapping: shape id -> class
        train, test,            # sequences of shape ids
        network=NetworkConfig(),
        training=TrainingConfig(),
        seed=0,
        checkpoint=Path("work/SHREC1-0.pt"),  # None: a killed training starts again
    )
    prediction.ids, prediction.classes        # tuples, n test shapes and k classes
    prediction.scores, prediction.embeddings  # (n, k) and (n, features) float32

`images` is read once, shape by shape, so it may load lazily from files: only the training
part is held in memory. ``gipkg.learning.config`` imports no torch, so that a workflow can
validate its configuration cheaply; everything else does.

The defaults are the network of today; the one of the paper is ``config.AS_IN_THE_PAPER``.
"""
