"""Hands, humans, octopuses, snakes and teddies: bodies of flesh."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from gipkg.datasets.articulated.skeleton import Skeleton
from gipkg.datasets.articulated.variation import joint, limb_lengths, meander, taper
from gipkg.datasets.proportions import vary

UP = Rotation.from_euler("Y", -np.pi / 2)
"""Frame whose x axis points up, and whose y axis points to the body's left."""


def hands(rng: np.random.Generator) -> Skeleton:
    """Pose a hand: a palm, and four fingers and a thumb that are more or less curled."""
    skeleton = Skeleton()
    spacing = vary(rng, 0.21, 0.15)
    thickness = 0.3 * spacing * rng.uniform(0.75, 1.1)
    wrist = skeleton.ball([0.0, 0.0, 0.0], 0.6 * spacing)
    forearm = Rotation.from_euler("ZY", np.array([np.pi, 0.0]) + rng.uniform(-0.4, 0.4, 2))
    skeleton.limb(wrist, forearm, [vary(rng, 0.4, 0.6)], [spacing * rng.uniform(0.55, 0.75)])

    length, curl = vary(rng, 0.62, 0.2), rng.uniform(0.0, 0.75)
    spread = rng.uniform(0.06, 0.2)
    knuckle = wrist
    for place, share in zip((-1.5, -0.5, 0.5, 1.5), (0.8, 1.0, 1.07, 0.95), strict=True):
        palm = [0.62 - 0.03 * place**2, place * spacing, 0.0]
        previous, knuckle = knuckle, skeleton.ball(palm, 0.5 * spacing, wrist)
        if previous != wrist:
            skeleton.join(previous, knuckle)
        own = rng.uniform(-0.1, 0.3) + curl
        frame = Rotation.from_euler("ZY", [spread * place, own * 0.8])
        lengths = limb_lengths(rng, share * length, (0.45, 0.3, 0.25), 0.06)
        bends = [joint(rng, own, 0.15), joint(rng, 0.7 * own, 0.1)]
        skeleton.limb(knuckle, frame, lengths, taper(thickness, 0.75 * thickness, 3), bends)

    frame = joint(rng, 0.25, 0.3, yaw=0.95, side=0.2)
    lengths = limb_lengths(rng, 0.85 * length, (0.5, 0.3, 0.2), 0.08)
    lengths[0] += 0.12
    bends = [joint(rng, 0.15, 0.3, yaw=-0.2, side=0.2), joint(rng, 0.2, 0.3)]
    skeleton.limb(wrist, frame, lengths, taper(1.3 * thickness, thickness, 3), bends)
    return skeleton


def humans(rng: np.random.Generator) -> Skeleton:
    """Pose a human: trunk, head, arms and legs, standing, walking, sitting or waving."""
    build = vary(rng, 1.0, 0.4)
    return _biped(
        rng,
        trunk=vary(rng, 0.55, 0.15),
        trunk_radius=0.13 * build,
        head_radius=vary(rng, 0.13, 0.2),
        arm=vary(rng, 0.72, 0.2),
        leg=vary(rng, 0.95, 0.2),
        limb_radius=0.062 * build,
        ears=False,
    )


def teddies(rng: np.random.Generator) -> Skeleton:
    """Pose a teddy: a stout trunk with a large head, round ears, short arms and legs."""
    build = vary(rng, 1.0, 0.3)
    return _biped(
        rng,
        trunk=vary(rng, 0.34, 0.25),
        trunk_radius=0.24 * build,
        head_radius=vary(rng, 0.23, 0.25),
        arm=vary(rng, 0.45, 0.3),
        leg=vary(rng, 0.45, 0.3),
        limb_radius=0.1 * build,
        ears=True,
    )


def octopuses(rng: np.random.Generator) -> Skeleton:
    """Pose an octopus: a mantle, and eight tapering arms that meander without joints."""
    skeleton = Skeleton()
    radius = vary(rng, 0.24, 0.2)
    head = skeleton.ball([0.0, 0.0, 0.0], radius)
    lean = UP * joint(rng, 0.0, 0.5, side=0.5)
    mantle = radius * rng.uniform([0.6, 0.5], [1.3, 1.2])
    skeleton.limb(
        head, lean, mantle, radius * np.array([vary(rng, 1.15, 0.2), 0.8]), [joint(rng, 0.0, 0.3)]
    )

    length, thickness = vary(rng, 1.35, 0.25), vary(rng, 0.075, 0.2)
    bones = 8
    for arm in range(8):
        yaw = 2 * np.pi * arm / 8
        frame = joint(rng, 0.35, 0.25, yaw=yaw, side=0.12)
        lengths = limb_lengths(rng, length, (1.0,) * bones, 0.05)
        lengths[0] += 0.8 * radius
        radii = taper(1.1 * thickness, 0.5 * thickness, bones)
        skeleton.limb(head, frame, lengths, radii, meander(rng, bones, rng.uniform(0.1, 0.5)))
    return skeleton


def snakes(rng: np.random.Generator) -> Skeleton:
    """Pose a snake: one long body with a head at one end and a thin tail at the other."""
    skeleton = Skeleton()
    bones = 26
    length, thickness = vary(rng, 3.2, 0.3), vary(rng, 0.075, 0.45)
    head = skeleton.ball([0.0, 0.0, 0.0], thickness * rng.uniform(1.0, 1.7))
    neck = skeleton.limb(head, Rotation.identity(), [1.8 * thickness], [0.85 * thickness])[-1]
    along = np.linspace(0.0, 1.0, bones)
    swelling = np.sin(np.pi * along) * rng.uniform(0.0, 0.7)
    radii = thickness * (0.9 + swelling - 0.45 * along ** rng.uniform(1.0, 4.0))
    bends = meander(rng, bones, rng.uniform(0.1, 0.55))
    skeleton.limb(neck, Rotation.identity(), np.full(bones, length / bones), radii, bends)
    return skeleton


def _biped(
    rng: np.random.Generator,
    trunk: float,
    trunk_radius: float,
    head_radius: float,
    arm: float,
    leg: float,
    limb_radius: float,
    ears: bool,
) -> Skeleton:
    skeleton = Skeleton()
    pelvis = skeleton.ball([0.0, 0.0, 0.0], trunk_radius * rng.uniform(0.85, 1.1))
    spine = UP * joint(rng, 0.05, 0.2, side=0.1)
    chest_frame = spine * joint(rng, 0.1, 0.3, side=0.15)
    chest = skeleton.limb(
        pelvis,
        spine,
        [trunk / 2, trunk / 2],
        trunk_radius * rng.uniform([0.85, 0.85], [1.15, 1.05]),
        [spine.inv() * chest_frame],
    )[-1]
    head_frame = chest_frame * joint(rng, 0.1, 0.35, side=0.3)
    height = 0.9 * skeleton.radius(chest) + rng.uniform(0.9, 1.2) * head_radius
    centre = skeleton.centre(chest) + height * head_frame.apply([1.0, 0.0, 0.0])
    head = skeleton.ball(centre, head_radius, chest, neck=0.45 * head_radius)
    if ears:
        for side in (-1.0, 1.0):
            frame = head_frame * Rotation.from_euler("Z", 0.85 * side)
            skeleton.limb(head, frame, [1.1 * head_radius], [0.38 * head_radius])
        snout = head_frame * Rotation.from_euler("Y", np.pi / 2)
        skeleton.limb(head, snout, [rng.uniform(0.8, 1.1) * head_radius], [0.45 * head_radius])

    for side in (-1.0, 1.0):
        raised = rng.uniform(-0.9, 1.0)
        shoulder_frame = chest_frame * Rotation.from_euler("Z", side * np.pi / 2)
        arm_frame = shoulder_frame * Rotation.from_euler(
            "ZY", [-side * raised, rng.uniform(-0.4, 0.7)]
        )
        # Elbows bend forwards and up.
        elbow = Rotation.from_euler("ZY", [-side * rng.uniform(0, 0.8), rng.uniform(0.0, 1.0)])
        lengths = np.append(1.1 * trunk_radius, limb_lengths(rng, arm, (0.45, 0.4, 0.15), 0.08))
        radii = limb_radius * np.array([1.15, 0.9, 0.75, 0.85])
        wrist = joint(rng, 0.0, 0.4, side=0.3)
        bends = [shoulder_frame.inv() * arm_frame, elbow, wrist]
        skeleton.limb(chest, shoulder_frame, lengths, radii, bends)

    for side in (-1.0, 1.0):
        hip_frame = Rotation.from_euler("ZY", [side * np.pi / 2, 0.7])
        leg_frame = Rotation.from_euler("Y", np.pi / 2) * Rotation.from_euler(
            "ZY", [side * rng.uniform(0.05, 0.5), -rng.uniform(-0.4, 1.3)]
        )
        lengths = np.append(0.75 * trunk_radius, limb_lengths(rng, leg, (0.45, 0.42), 0.08))
        radii = limb_radius * np.array([1.45, 1.1, 0.85])
        knee = Rotation.from_euler("Y", rng.uniform(0.0, 1.2))
        bends = [hip_frame.inv() * leg_frame, knee]
        ankle = skeleton.limb(pelvis, hip_frame, lengths, radii, bends)[-1]
        foot = leg_frame * knee * joint(rng, -1.3, 0.3)
        skeleton.limb(ankle, foot, [0.2 * leg + 0.02], [0.8 * limb_radius])
    return skeleton
