"""Tables: CSV, XLSX, and what pages take from them."""
