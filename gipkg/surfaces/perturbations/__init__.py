"""What may be wrong with a surface: one perturbation a module, and the way back to genus 0."""

from gipkg.surfaces.perturbations.catalogue import PERTURBATIONS, perturb

__all__ = ["PERTURBATIONS", "perturb"]
