"""Launch files: which processes follow from their arguments, and the actions of `launch`."""
