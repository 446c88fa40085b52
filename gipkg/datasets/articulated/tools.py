"""Pliers and spectacles: stiff parts on hinges, and not always of genus 0."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from gipkg.datasets.articulated.skeleton import Skeleton
from gipkg.datasets.articulated.variation import joint, limb_lengths, taper
from gipkg.datasets.proportions import vary

CLOSED_PLIERS = 1 / 3
"""Share of pliers whose jaws are shut around a gap: a handle of the surface."""
RIM_BONES = 14


def pliers(rng: np.random.Generator) -> Skeleton:
    """Pose pliers: two levers that cross at a pivot: long curved handles, short jaws."""
    skeleton = Skeleton()
    thickness = vary(rng, 0.075, 0.25)
    pivot = skeleton.ball([0.0, 0.0, 0.0], 1.6 * thickness)
    handle, jaw = vary(rng, 1.3, 0.25), vary(rng, 0.5, 0.3)
    opening, curve = rng.uniform(0.35, 0.8), rng.uniform(0.1, 0.6)
    shut = rng.random() < CLOSED_PLIERS
    # Shut jaws make a kite: they turn back until they meet on the axis.
    bulge = rng.uniform(0.65, 0.9) if shut else opening + rng.uniform(0.05, 0.2)
    back = (2.0 if shut else 0.6) * bulge

    tips = []
    for side in (-1.0, 1.0):
        frame = Rotation.from_euler("Z", np.pi - side * opening)
        lengths = limb_lengths(rng, handle, (0.3, 0.35, 0.35), 0.08)
        bends = [joint(rng, 0.0, 0.08, yaw=side * bend) for bend in (curve, 0.5 * curve)]
        skeleton.limb(pivot, frame, lengths, thickness * rng.uniform(0.8, 1.15, 3), bends)

        frame = Rotation.from_euler("Z", side * bulge)
        radii = thickness * np.array([1.0, 0.8])
        bends = [Rotation.from_euler("Z", -side * back)]
        tips.append(skeleton.limb(pivot, frame, [jaw / 2 + thickness, jaw / 2], radii, bends)[-1])
    if shut:
        skeleton.join(*tips)
        skeleton.genus = 1
    return skeleton


def spectacles(rng: np.random.Generator) -> Skeleton:
    """Pose spectacles: two open rims, the bridge between them, and two temples on hinges."""
    skeleton = Skeleton()
    skeleton.genus = 2
    thickness = vary(rng, 0.042, 0.25)
    width, height = vary(rng, 0.36, 0.15), vary(rng, 0.26, 0.25)
    squareness = rng.uniform(0.55, 1.0)
    bridge = vary(rng, 0.22, 0.3)
    temple, fold = vary(rng, 1.15, 0.25), rng.uniform(-0.25, 1.3)

    angle = 2 * np.pi * np.arange(RIM_BONES) / RIM_BONES
    outline = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outline = np.sign(outline) * np.abs(outline) ** squareness * [width, height]
    noses = []
    for side in (-1.0, 1.0):
        centre = side * (width + bridge / 2)
        rim = [
            skeleton.ball([centre + side * x, 0.0, z], thickness * rng.uniform(0.9, 1.1))
            for x, z in outline
        ]
        for first, second in zip(rim, rim[1:] + rim[:1], strict=True):
            skeleton.join(first, second)
        noses.append(rim[RIM_BONES // 2])
        joint_at = skeleton.centre(rim[0]) + np.array([side * 2 * thickness, 0.0, 0.0])
        hinge = skeleton.ball(joint_at, 1.2 * thickness, rim[0])
        own = fold + rng.uniform(-0.25, 0.25)
        frame = Rotation.from_euler("Z", -np.pi / 2 - side * own) * joint(rng, 0.0, 0.08)
        lengths = limb_lengths(rng, temple, (0.5, 0.25, 0.25), 0.05)
        bends = [joint(rng, 0.15, 0.15), joint(rng, 0.4, 0.3)]
        skeleton.limb(hinge, frame, lengths, taper(thickness, thickness, 3), bends)
    skeleton.join(*noses)
    return skeleton
