"""Pictures: data and an ax in, the ax out; one file per chapter."""
