"""Strong-motion records, input motions, processing and quality control."""

from seisblock.records.floor_motion import Storey
from seisblock.records.motion import Motion, motion_of
from seisblock.records.preparation import Preparation
from seisblock.records.qc_flags import QCFlag
from seisblock.records.record import Component, Record

__all__ = ["Component", "QCFlag", "Motion", "Preparation", "Record", "Storey", "motion_of"]
