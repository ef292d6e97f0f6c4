"""Tables, files and figures of an evaluation."""
