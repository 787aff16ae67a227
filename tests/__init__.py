import os

# as the command line does, before anything loads the linear algebra
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
