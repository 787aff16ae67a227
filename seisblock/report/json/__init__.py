"""JSON documents of the commands: SI units, the unit in each key, a schema generated from the same types.

One module per command defines its parameters and results, ``registry`` lists them and those of the models (``models/NAME/document.py``) and
prints JSON Schema. A new command adds its module and its line in the registry. ``output/json`` holds what all documents share.
"""
