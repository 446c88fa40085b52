"""Predictions and maps to figures: accuracy, retrieval, distortion."""
