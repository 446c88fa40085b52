"""Ants, crabs and spiders: a body in two or three parts and jointed legs around it."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from gipkg.datasets.articulated.skeleton import Skeleton
from gipkg.datasets.articulated.variation import joint, limb_lengths, taper
from gipkg.datasets.proportions import vary

LEFT, RIGHT = 1.0, -1.0


def ants(rng: np.random.Generator) -> Skeleton:
    """Pose an ant: head, thorax and abdomen in a row, six legs on the thorax and two antennae."""
    skeleton = Skeleton()
    thorax = skeleton.ball([0.0, 0.0, 0.0], vary(rng, 0.15, 0.2))
    head = _body_part(skeleton, rng, thorax, yaw=0.0, radius=vary(rng, 0.17, 0.25), long=0.4)
    _body_part(skeleton, rng, thorax, yaw=np.pi, radius=vary(rng, 0.22, 0.3), long=1.2)
    thickness, length = vary(rng, 0.042, 0.25), vary(rng, 0.95, 0.25)
    _legs(skeleton, rng, thorax, np.radians([50, 90, 130]), length, thickness)
    antennae = vary(rng, 0.5, 0.4)
    for side in (LEFT, RIGHT):
        frame = joint(rng, -0.5, 0.35, yaw=0.55 * side, side=0.2)
        lengths = skeleton.radius(head) + limb_lengths(rng, antennae, (1.0, 1.0))
        radii = taper(thickness, 0.8 * thickness, 2)
        skeleton.limb(head, frame, lengths, radii, [joint(rng, 0.6, 0.4)])
    return skeleton


def spiders(rng: np.random.Generator) -> Skeleton:
    """Pose a spider: a head that carries eight long legs, and a large abdomen."""
    skeleton = Skeleton()
    head = skeleton.ball([0.0, 0.0, 0.0], vary(rng, 0.19, 0.2))
    _body_part(skeleton, rng, head, yaw=np.pi, radius=vary(rng, 0.27, 0.3), long=0.6)
    thickness, length = vary(rng, 0.042, 0.25), vary(rng, 1.15, 0.25)
    _legs(skeleton, rng, head, np.radians([38, 72, 106, 138]), length, thickness)
    if rng.random() < 0.6:
        palps = vary(rng, 0.3, 0.3)
        for side in (LEFT, RIGHT):
            frame = joint(rng, 0.2, 0.3, yaw=0.22 * side, side=0.05)
            lengths = [skeleton.radius(head) + palps]
            skeleton.limb(head, frame, lengths, [thickness])
    return skeleton


def crabs(rng: np.random.Generator) -> Skeleton:
    """Pose a crab: a wide shell, eight walking legs and two claws in front."""
    skeleton = Skeleton()
    radius, width = vary(rng, 0.2, 0.25), vary(rng, 0.17, 0.3)
    middle = skeleton.ball([0.0, 0.0, 0.0], radius)
    flanks = {
        side: skeleton.ball([0.0, side * width, 0.0], vary(rng, 0.9, 0.1) * radius, middle)
        for side in (LEFT, RIGHT)
    }
    thickness, length = vary(rng, 0.042, 0.25), vary(rng, 0.8, 0.25)
    claw = vary(rng, 1.0, 0.2)
    for side, flank in flanks.items():
        for yaw in np.radians([62, 88, 114, 140]):
            _leg(skeleton, rng, flank, side * yaw, length, thickness)
        frame = joint(rng, -0.1, 0.3, yaw=0.5 * side, side=0.15)
        lengths = skeleton.radius(flank) * np.array([1, 0]) + limb_lengths(rng, claw, (0.3, 0.4))
        radii = thickness * np.array([1.2, 2.2])
        inwards = joint(rng, 0.0, 0.3, yaw=-0.7 * side, side=0.5)
        hand = skeleton.limb(flank, frame, lengths, radii, [inwards])[-1]
        opening = rng.uniform(0.45, 0.7)
        for finger in (-opening, opening):
            fork = frame * inwards * Rotation.from_euler("Z", finger)
            skeleton.limb(hand, fork, [0.26 * claw], [thickness])
    return skeleton


def _body_part(
    skeleton: Skeleton,
    rng: np.random.Generator,
    parent: int,
    yaw: float,
    radius: float,
    long: float,
) -> int:
    """Add an egg-shaped part of the body behind or before its parent."""
    frame = joint(rng, 0.0, 0.35, yaw=yaw, side=0.35)
    distance = (skeleton.radius(parent) + radius) * rng.uniform(0.85, 1.1)
    centre = skeleton.centre(parent) + distance * frame.apply([1.0, 0.0, 0.0])
    near = skeleton.ball(centre, radius, parent, neck=0.5 * min(radius, skeleton.radius(parent)))
    frame = frame * joint(rng, 0.0, 0.2, side=0.2)
    far = centre + radius * long * rng.uniform(0.6, 1.2) * frame.apply([1.0, 0.0, 0.0])
    skeleton.ball(far, radius * rng.uniform(0.6, 0.95), near)
    return near


def _legs(
    skeleton: Skeleton,
    rng: np.random.Generator,
    root: int,
    yaws: np.ndarray,
    length: float,
    thickness: float,
) -> None:
    for side in (LEFT, RIGHT):
        for yaw in yaws:
            _leg(skeleton, rng, root, side * yaw, length, thickness)


def _leg(
    skeleton: Skeleton,
    rng: np.random.Generator,
    root: int,
    yaw: float,
    length: float,
    thickness: float,
) -> None:
    """Add a leg that rises to its knee and falls to its foot."""
    frame = joint(rng, -0.45, 0.35, yaw=yaw, side=0.12)
    lengths = limb_lengths(rng, length, (0.4, 0.35, 0.25))
    lengths[0] += skeleton.radius(root)
    bends = [joint(rng, 0.95, 0.45, side=0.2), joint(rng, 0.15, 0.5, side=0.2)]
    skeleton.limb(root, frame, lengths, taper(1.15 * thickness, 0.85 * thickness, 3), bends)
