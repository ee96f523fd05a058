"""Drawings as shapes, whatever they are drawn on."""
