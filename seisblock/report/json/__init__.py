"""What a command answers, as one typed document: SI, the unit in each key's name, a schema that follows from the same types.

``kind`` says what a document is made of, ``entry`` makes keys of results and bodies, one file per command says which, ``catalogue`` lists
them, and ``schema`` prints them as JSON Schema. A new command adds its file and its line in the catalogue.
"""
