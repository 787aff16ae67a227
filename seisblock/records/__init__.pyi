from .floor import Storey, floor_motion
from .motion import Motion, motion_of
from .preparation import Preparation
from .process import component_at_azimuth, crop, demean, highpass, rotate, scale, scale_to_jma, scale_to_pga
from .qc_flags import QCFlag
from .record import Component, Record
from .synthetic.suite import synthetic_suite

__all__ = [
    "Component",
    "component_at_azimuth",
    "crop",
    "demean",
    "floor_motion",
    "highpass",
    "Motion",
    "motion_of",
    "Preparation",
    "QCFlag",
    "Record",
    "rotate",
    "scale",
    "scale_to_jma",
    "scale_to_pga",
    "Storey",
    "synthetic_suite",
]
