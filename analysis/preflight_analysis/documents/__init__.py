"""Text to Document: error-tolerant parses with a span on everything."""
