"""Document versions by command."""

VERSIONS = {
    "measure": 1,
    "respond": 1,
    "slide": 1,
    "rock": 1,
    "jump": 2,
    "uplift": 1,
    "stack": 3,
    "criteria": 1,
    "spectrum": 1,
    "overturn-rate": 2,
    "infer": 2,
    "body": 1,
    "batch": 1,
    "map": 1,
    "fragility": 1,
    "risk": 1,
    "fit": 1,
    "validate": 1,
    "cite": 1,
    "samples": 1,
}
"""Incremented when a key is removed or changes name, unit or type; not when one is added."""


def schema_name(command: str) -> str:
    """Return the value of the key ``schema``."""
    return f"seisblock/{command}/{VERSIONS[command]}"
