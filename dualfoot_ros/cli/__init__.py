"""The ``dualfoot`` command: one thin file a verb, everything else in the library."""
