"""What a camera, and whoever uses it, can prove about itself."""
