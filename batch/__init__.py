"""The ``aadm`` command: job files, the batch runner and one module a command. Installed as the package aadm_batch.

Modules import each other relatively, because the folder and the installed package have different names.
"""
