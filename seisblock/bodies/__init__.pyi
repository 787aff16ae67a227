from .block import Block, from_slenderness
from .cemetery.cemetery import Cemetery, Stone
from .cemetery.table import read_cemetery
from .convex import ConvexBody
from .edge_wear import EdgeWear
from .factory import load_block
from .pile.contact import PileContact
from .pile.pile import Pile
from .pile.stone import PileStone
from .pile.toml import load_pile
from .scan.body import ScannedBody
from .scan.scan import Scan, scan_body
from .scan.toml import load_scan
from .sliding_base import SlidingBase
from .spring_block import SpringBlock
from .table import BodySpec, read_bodies
from .two_layer import Contact, TwoLayerBlock, load_contact, load_two_layer
from .uncertainty import ParameterRanges

__all__ = [
    "Block",
    "BodySpec",
    "Cemetery",
    "Contact",
    "ConvexBody",
    "EdgeWear",
    "from_slenderness",
    "load_block",
    "load_contact",
    "load_pile",
    "load_scan",
    "load_two_layer",
    "ParameterRanges",
    "Pile",
    "PileContact",
    "PileStone",
    "read_bodies",
    "read_cemetery",
    "Scan",
    "scan_body",
    "ScannedBody",
    "SlidingBase",
    "SpringBlock",
    "Stone",
    "TwoLayerBlock",
]
