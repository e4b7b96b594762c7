"""Studies: many buildings, priors and surveys through the parts of the pipeline; a table comes out."""
