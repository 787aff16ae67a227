from .solve import SlideOutcome, solve_slide

__all__ = ["SlideOutcome", "solve_slide"]
