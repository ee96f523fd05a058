"""``python -m aadm_batch`` does what ``aadm`` does."""

from .main import main

if __name__ == "__main__":
    raise SystemExit(main())
