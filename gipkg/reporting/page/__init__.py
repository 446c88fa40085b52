"""The page that shows a whole run: the paper's figures beside ours, and shapes to turn."""
