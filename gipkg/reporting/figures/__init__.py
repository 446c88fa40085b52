"""The paper's figures, one module each: what they show as numbers, and drawn."""
