"""Any mesh to a closed, oriented genus-0 surface of one component."""
