"""Bringing an estimate and a reference together in time and space."""
