"""Figures and tables of the thesis, made anew with our buildings: a picture, our numbers, and a verdict that is computed."""
