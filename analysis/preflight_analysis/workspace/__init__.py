"""The pieces put together: from the files of a workspace to its findings, each step memoised."""
