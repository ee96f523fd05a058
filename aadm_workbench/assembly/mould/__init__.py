"""What the moulds of a shipment do to their columns."""
