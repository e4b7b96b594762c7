"""The thesis's figures and tables, computed again."""
