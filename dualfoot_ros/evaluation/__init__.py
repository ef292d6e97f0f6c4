"""Metrics, reports and plots of a walk: against truth, floor markers, or the feet themselves."""
