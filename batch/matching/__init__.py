"""Which column of a shipment goes on which bars."""
