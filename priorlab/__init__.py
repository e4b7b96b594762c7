"""priorlab: what does a Bayesian prior do to a robot's map?

An image of a drawing -> corners -> doors -> walls -> prior map -> (readings -> evidence) -> posterior map -> score -> sweep,
Pareto front, clusters -> the same with poses that must be estimated (FastSLAM).

Every probability is P(the cell is EMPTY): wall = low, space = high, white = empty.

The public names stand in `__init__.pyi`; each is imported when it is first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
