"""The compiled part of sikku, and what it loads."""
