"""Document to LaunchFile: one shape for all launch formats, values still unevaluated."""
