"""One module a command. Their heavy imports stand inside ``run``: ``aadm --help`` must not wait for them."""
