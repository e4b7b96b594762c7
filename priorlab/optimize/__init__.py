"""Every prior at once: experiment, exact sweep, Pareto front, clusters."""
