"""Floor 0: what every chapter shares - the frame, log odds, the records, the score, pictures and files.

Nothing in here imports another part of priorlab.
"""
