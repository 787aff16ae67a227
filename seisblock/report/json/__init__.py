"""JSON documents of the commands: SI units, the unit in each key, a schema generated from the same types.

``schema`` defines documents, ``entries`` and ``bodies`` make the keys of results and bodies, one module per command defines its parameters
and results, ``registry`` lists them and prints JSON Schema. A new command adds its module and its line in the registry.
"""
