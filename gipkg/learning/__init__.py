"""Geometry images to class scores and shape signatures (paper, Sections 4.2 and 5).

A network is trained on one part of a split, predicts the other, and is kept for more::

    from gipkg.learning.config import NetworkConfig, TrainingConfig
    from gipkg.learning.model import load_model, train_model

    model = train_model(
        images,                    # mapping: shape id -> (views, C, n, n) float32, unpadded
        labels,                    # mapping: shape id -> class
        train_ids,                 # sequence of shape ids
        network=NetworkConfig(),   # the defaults are the network and training of today
        training=TrainingConfig(),
        seed=0,
        checkpoint=Path("work/SHREC1-0.pt"),  # a killed training goes on from here
    )
    prediction = model.predict(images, test_ids)
    prediction.scores, prediction.embeddings  # (n, k) and (n, 48) float32, views pooled

    model.save(Path("SHREC1-0.model.npz"))
    load_model(Path("SHREC1-0.model.npz")).predict(other_images, other_ids)

`images` is read shape by shape, so it may load lazily from files: only the training part is held
in memory. ``gipkg.learning.config`` and ``gipkg.learning.prediction`` import no torch, so that a
workflow can check its configuration cheaply.
"""
