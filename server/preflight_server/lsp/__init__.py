"""The language server: position to query to conversion. No analysis lives here."""
