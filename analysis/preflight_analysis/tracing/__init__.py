"""Node and its configuration to Interface, by a run in the sandbox, cached with what it depended on."""
