"""Inputs of the nodes: streams of the feet, their stamps, calibrations, field and pressure."""
