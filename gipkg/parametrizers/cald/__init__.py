"""The three parts of CALD (Shen & Makedon 2006): initial map, local and global smoothing."""
