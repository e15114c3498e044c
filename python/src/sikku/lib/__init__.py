"""The compiled part of sikku, with the libraries and data that it loads."""
