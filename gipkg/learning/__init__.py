"""Geometry images to class scores and shape signatures (paper, Sections 4.2 and 5).

One call trains a network on one part of a split and predicts the other::

    from gipkg.learning.config import NetworkConfig, TrainingConfig
    from gipkg.learning.experiment import train_and_predict

    prediction = train_and_predict(
        images,                    # mapping: shape id -> (views, C, n, n) float32, unpadded
        labels,                    # mapping: shape id -> class, of the training part
        train_ids, test_ids,       # sequences of shape ids
        network=NetworkConfig(),   # the defaults are the network and training of today
        training=TrainingConfig(),
        seed=0,
        checkpoint=Path("work/SHREC1-0.pt"),  # a killed training goes on from here
    )
    prediction.scores, prediction.embeddings  # (n, k) and (n, 48) float32, views pooled

`images` is read shape by shape, so it may load lazily from files: only the training part is held
in memory. ``gipkg.learning.config`` and ``gipkg.learning.prediction`` import no torch, so that a
workflow can check its configuration cheaply.
"""
