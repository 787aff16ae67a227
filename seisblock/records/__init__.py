"""What was measured: records, motions, and the processing between them."""

from seisblock.records.doubts import Doubt
from seisblock.records.motion import Motion, motion_of
from seisblock.records.preparation import Preparation
from seisblock.records.record import Component, Record
from seisblock.records.storey import Storey

__all__ = ["Component", "Doubt", "Motion", "Preparation", "Record", "Storey", "motion_of"]
