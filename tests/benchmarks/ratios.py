"""The arithmetic of comparisons: medians, quartiles, ratios, and when a stage counts as slower."""

import statistics

LEAST_SLOWDOWN = 0.03  # of times: less is never told from noise
LEAST_PAIRS = 3  # fewer do not show their noise
SPREADS = 1.5  # quartile distances that the median of the ratios has to lie above 1
COUNT_SLOWDOWN = 0.005  # of instruction counts: addresses and hashes move them by a tenth of that


def quartiles(values):
    """Lower quartile, median and upper quartile, interpolated; of one value that value three times."""
    if len(values) == 1:
        return (values[0],) * 3
    lower, middle, upper = statistics.quantiles(values, n=4, method="inclusive")
    return lower, middle, upper


def pair_ratios(first, second):
    """Ratios of the medians of paired runs: lists of lists of seconds, run by run."""
    return [statistics.median(b) / statistics.median(a) for a, b in zip(first, second, strict=True)]


def slower(ratios):
    """Whether times rose by more than their noise: the median of the ratios by more than LEAST_SLOWDOWN and by more
    than SPREADS times the distance of their quartiles. Fewer than LEAST_PAIRS say nothing."""
    if len(ratios) < LEAST_PAIRS:
        return False
    lower, middle, upper = quartiles(ratios)
    return middle > 1 + max(LEAST_SLOWDOWN, SPREADS * (upper - lower))


def limit(needs, cost, units):
    """What a stage cannot do without: units needed of each kernel, at the cost of a run over the units of one."""
    return sum(amount / units[kernel] * cost[kernel] for kernel, amount in needs.items())


def distance(cost, needs, costs, units):
    """Cost of a stage over its limit, or None where no limit is known."""
    unavoidable = limit(needs, costs, units)
    return cost / unavoidable if unavoidable > 0 else None


def against_baseline(counts, stored, tolerance):
    """(scene, stage, ratio, verdict) of all that are in both, verdict "", "slower" or "faster"."""
    rows = []
    for scene, stages in stored.items():
        for stage, was in stages.items():
            if stage in counts.get(scene, {}):
                ratio = counts[scene][stage] / was["instructions"]
                verdict = "slower" if ratio > 1 + tolerance else "faster" if ratio < 1 - tolerance else ""
                rows.append((scene, stage, ratio, verdict))
    return rows
