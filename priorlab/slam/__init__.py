"""Chapter 6: the pose is estimated too (Monte Carlo localization and FastSLAM)."""
