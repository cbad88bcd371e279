"""What hears transforms."""

from . import Transformer, TransformerROS, TransformListener

__all__ = ["TransformListener", "Transformer", "TransformerROS"]
