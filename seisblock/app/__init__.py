"""Local page of ``seisblock app``: forms and results in a browser, for readers without a command line (extra ``app``).

The page runs the commands themselves, each in a worker process (:mod:`seisblock.app.jobs`), and shows their documents and figures; it
holds no physics. Starlette serves it, htmx replaces its parts.
"""
