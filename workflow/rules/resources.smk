def memory(megabytes):
    """Return what a job may take, in MB; as much again at every retry.

    At least twice what the largest jobs took (docs/scaling.md). A cluster is asked for as much, and
    a job that takes more is ended there, not another.
    """
    return lambda wildcards, attempt: attempt * megabytes


def memory_of_input(megabytes, times):
    """Return what a job may take that holds its input in memory: so many MB, and its size."""
    return lambda wildcards, input, attempt: attempt * int(megabytes + times * input.size_mb)
