# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of several sources fused by their covariances, without a source that contradicts the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import EstimationError
from forcetorque.base.units import NORMAL_95
from forcetorque.estimation.torque.torque_source import TorqueSource


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowMeans:
    """Means of one source."""

    torque: FloatArray
    """Means, NaN where the source says nothing; shape (w, j); N m."""
    noise: FloatArray
    """Covariance of their noise; shape (w, j, j); (N m)^2."""
    lasting: FloatArray
    """Means of what its lasting errors add; shape (w, j, p); N m."""

    def window(self, index: int) -> WindowMeans:
        """Select one window.

        Args:
            index: Its place.

        Returns:
            The means of that window alone.
        """
        one = slice(index, index + 1)
        return WindowMeans(torque=self.torque[one], noise=self.noise[one], lasting=self.lasting[one])


def means_in_windows(sources: Sequence[TorqueSource], window_s: float) -> tuple[WindowMeans, ...]:
    """Average sources over windows.

    A mean of a joint is over samples of which every source knows the joint; a source that knows it in less than half of
    the samples of a window has no mean there, so that the others are not cut short by it.

    Args:
        sources: Sources with the same instants and joints.
        window_s: Length of a window; s.

    Returns:
        Means of every source.
    """
    stamps = sources[0].stamp_ns
    window = (stamps - stamps[0]) // round(window_s * 1e9)
    starts: IntArray = np.flatnonzero(np.diff(window, prepend=-1)).astype(np.int64)
    lengths = np.diff(starts, append=len(stamps))
    known = [np.isfinite(source.torque) for source in sources]
    # whether a source has a mean of a joint in a window
    heard = [np.add.reduceat(one, starts) * 2 >= lengths[:, None] for one in known]
    spread = [np.repeat(one, lengths, axis=0) for one in heard]
    common = np.all([one | ~there for one, there in zip(known, spread, strict=True)], axis=0)
    return tuple(
        _means(source, common & there, starts, window_s) for source, there in zip(sources, spread, strict=True)
    )


def _means(source: TorqueSource, taken: BoolArray, starts: IntArray, window_s: float) -> WindowMeans:
    counts = np.add.reduceat(taken, starts)
    with np.errstate(invalid="ignore"):
        torque = np.add.reduceat(np.where(taken, source.torque, 0.0), starts) / counts
        lasting = np.add.reduceat(np.where(taken[:, :, None], source.lasting, 0.0), starts) / counts[:, :, None]
        pairs = taken[:, :, None] & taken[:, None, :]
        noise = np.add.reduceat(np.where(pairs, source.noise, 0.0), starts)
        noise = noise / (counts[:, :, None] * counts[:, None, :])
    return WindowMeans(
        torque=torque,
        noise=np.nan_to_num(noise) * _repeated(source, counts, window_s)[:, None, None],
        lasting=np.nan_to_num(lasting),
    )


def _repeated(source: TorqueSource, counts: IntArray, window_s: float) -> FloatArray:
    """How many samples are as good as one, because noise repeats itself; shape (w,)."""
    period_s = float(np.median(np.diff(source.stamp_ns))) * 1e-9 if len(source) > 1 else window_s
    most = np.maximum(counts.max(axis=1), 1).astype(np.float64)
    return np.minimum(1.0 + 2.0 * source.noise_time_s / period_s, most)


def precisions(values: FloatArray, covariance: FloatArray) -> FloatArray:
    """Invert the covariance of what is known of every vector.

    Args:
        values: Vectors, NaN where a component is not known; shape (n, j).
        covariance: Their covariance; shape (n, j, j).

    Returns:
        Weights, zero in rows and columns of what is not known; shape (n, j, j).
    """
    known = ~np.isnan(values)
    weights = np.zeros_like(covariance)
    for pattern in np.unique(known, axis=0):
        columns = np.flatnonzero(pattern)
        block = np.ix_(np.flatnonzero((known == pattern).all(axis=1)), columns, columns)
        weights[block] = np.linalg.inv(covariance[block])
    return weights


def combined(
    values: Sequence[FloatArray], covariances: Sequence[FloatArray], shared: Sequence[FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Find the vectors that several measurements fit best, with `values = vector + shared @ w + e`.

    w has unit variance and is the same for all measurements of a vector, e is independent between them. Measurements
    with the same `shared` keep that error: their number does not reduce it.

    Args:
        values: Measurements, NaN where a component is not known; shape (n, j) each.
        covariances: Covariances of their e; shape (n, j, j) each.
        shared: What one standard deviation of each common error adds; shape (n, j, s) each, with one s.

    Returns:
        The vectors, NaN where a component is unknown, shape (n, j); and their covariance, shape (n, j, j).
    """
    n, _, s = shared[0].shape
    information, cross, own = np.zeros_like(covariances[0]), np.zeros_like(shared[0]), np.tile(np.eye(s), (n, 1, 1))
    right, right_shared = np.zeros_like(values[0]), np.zeros((n, s))
    for value, covariance, columns in zip(values, covariances, shared, strict=True):
        weights, columns_known = precisions(value, covariance), np.nan_to_num(columns)
        weighted = np.einsum("nij,nj->ni", weights, np.nan_to_num(value))
        information += weights
        cross += weights @ columns_known
        own += columns_known.transpose(0, 2, 1) @ weights @ columns_known
        right += weighted
        right_shared += np.einsum("njs,nj->ns", columns_known, weighted)
    # the common errors are eliminated: what is left is the information on the vectors alone
    eliminated = np.linalg.solve(own, np.concatenate([cross.transpose(0, 2, 1), right_shared[:, :, None]], axis=2))
    information -= cross @ eliminated[:, :, :-1]
    right -= np.einsum("njs,ns->nj", cross, eliminated[:, :, -1])
    unknown = np.all([np.isnan(value) for value in values], axis=0)
    covariance = inverse_of_known(0.5 * (information + information.transpose(0, 2, 1)), unknown)
    vectors = np.einsum("nij,nj->ni", covariance, right)
    vectors[unknown] = np.nan
    covariance[unknown[:, :, None] | unknown[:, None, :]] = np.nan
    return vectors, covariance


def inverse_of_known(weights: FloatArray, unknown: BoolArray) -> FloatArray:
    """Invert weights whose rows and columns of unknown components are zero.

    Args:
        weights: The weights; shape (n, j, j).
        unknown: Whether a component is unknown; shape (n, j), bool.

    Returns:
        The covariance of what is known, zero elsewhere; shape (n, j, j).
    """
    # the unknown components stand apart from the others: with a one on their diagonal all is inverted at once
    apart = unknown[:, :, None] * np.eye(unknown.shape[1])
    return np.linalg.inv(weights + apart) - apart


VARIANCE_MARGIN = 1.25
"""Factor by which the noise of sources may be more than specified before that is a conflict: variances of noise are
estimates themselves, from as many samples as a recording has, and hundreds of windows determine them to a few
percent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Innovation:
    """A sum of squared normalised innovations."""

    chi2: float
    """The sum; as large as the degrees of freedom on average, if the covariances are right."""
    degrees_of_freedom: int
    """Number of independent ones."""

    @property
    def probability(self) -> float:
        """Probability of at least so much by chance; 1 where nothing is compared."""
        if not self.degrees_of_freedom:
            return 1.0
        from scipy.special import chdtrc

        return float(chdtrc(self.degrees_of_freedom, max(self.chi2, 0.0)))

    @property
    def ratio(self) -> float:
        """Mean squared innovation: about 1 if the covariances are right, 0 where nothing is compared."""
        return self.chi2 / self.degrees_of_freedom if self.degrees_of_freedom else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """Squared normalised innovations of sources against each other, in two independent parts."""

    lasting: Innovation
    """Of the lasting errors that sources show of each other: few numbers, in which an offset shows."""
    passing: Innovation
    """Of all that changes from window to window beyond these: many numbers, in which a variance shows."""

    @property
    def total(self) -> Innovation:
        """Both together."""
        return Innovation(
            chi2=self.lasting.chi2 + self.passing.chi2,
            degrees_of_freedom=self.lasting.degrees_of_freedom + self.passing.degrees_of_freedom,
        )

    def alarms(self, false_alarm: float) -> bool:
        """Check whether it is larger than chance makes it.

        Args:
            false_alarm: Largest rate at which chance does.

        Returns:
            Whether either part is too large, the passing one by more than `VARIANCE_MARGIN`.
        """
        passing = Innovation(
            chi2=self.passing.chi2 / VARIANCE_MARGIN, degrees_of_freedom=self.passing.degrees_of_freedom
        )
        compared = [part for part in (self.lasting, passing) if part.degrees_of_freedom]
        # the parts are independent: each has the rate with which any of them is too large as often as is allowed
        rate = 1.0 - (1.0 - false_alarm) ** (1.0 / max(1, len(compared)))
        return any(part.probability < rate for part in compared)


def disagreement(sources: Sequence[WindowMeans]) -> Disagreement:
    """Fit torques and lasting errors to all windows at once, and sum up what is left.

    With `y_k = torque + lasting_k z_k + noise_k` and z of unit variance, the torques are eliminated window by window,
    which leaves the normal equations `(H + 1) z = g` of the few z. Along an eigenvector of H with eigenvalue h, g has
    the variance h (h + 1). Where h is above 1, sources say more of each other's lasting errors than was known of them
    before: there `g^2 / (h (h + 1))` is the squared innovation of a lasting error.

    Args:
        sources: Means of the sources over the same windows.

    Returns:
        What they have against each other; nothing for a single source.
    """
    known = np.array([np.isfinite(source.torque) for source in sources])
    count = int(known.sum() - known.any(axis=0).sum())
    if not count:
        nothing = Innovation(chi2=0.0, degrees_of_freedom=0)
        return Disagreement(lasting=nothing, passing=nothing)
    weights = [precisions(source.torque, source.noise) for source in sources]
    ends = np.cumsum([1, *(source.lasting.shape[2] for source in sources)])
    # the torque of every source in the first column, what lasts in columns of its own: one elimination for both
    columns = np.zeros((len(sources), *known.shape[1:], ends[-1]))
    for k, source in enumerate(sources):
        columns[k, :, :, 0] = np.nan_to_num(source.torque)
        columns[k, :, :, ends[k] : ends[k + 1]] = source.lasting
    weighted = np.stack(weights) @ columns
    together = weighted.sum(axis=0)
    covariance = inverse_of_known(np.sum(weights, axis=0), np.logical_not(known.any(axis=0)))
    square = np.einsum("swji,swjk->ik", columns, weighted, optimize=True)
    square -= np.einsum("wji,wjk->ik", together, covariance @ together, optimize=True)
    values, vectors = np.linalg.eigh(square[1:, 1:])
    gradient = vectors.T @ square[1:, 0]
    sure = values > 1.0
    lasting = gradient[sure] ** 2 / (values[sure] * (values[sure] + 1.0))
    explained = np.sum(gradient[sure] ** 2 / values[sure]) + np.sum(gradient[~sure] ** 2 / (values[~sure] + 1.0))
    number = int(np.count_nonzero(sure))
    return Disagreement(
        lasting=Innovation(chi2=float(lasting.sum()), degrees_of_freedom=number),
        passing=Innovation(chi2=float(square[0, 0] - explained), degrees_of_freedom=count - number),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """What the sources of an interval, or of a window, have against each other."""

    is_there: bool
    """Whether they disagree by more than chance makes them."""
    everyone: Disagreement
    """Of all sources."""
    without: Mapping[str, Disagreement]
    """Of the others, by the source that is left out."""
    suspects: tuple[str, ...]
    """Sources without which the others agree, where there is a conflict."""

    @property
    def source(self) -> str | None:
        """The source in conflict; None without conflict, and where several or none alone explain it."""
        return self.suspects[0] if len(self.suspects) == 1 else None

    def innovation(self, source: str) -> Innovation:
        """Give the innovation of one source against all others together.

        Args:
            source: Its name.

        Returns:
            What the disagreement is less without it.
        """
        total, rest = self.everyone.total, self.without[source].total
        return Innovation(
            chi2=total.chi2 - rest.chi2, degrees_of_freedom=total.degrees_of_freedom - rest.degrees_of_freedom
        )


def conflict_between(sources: Mapping[str, WindowMeans], false_alarm: float) -> Conflict:
    """Find a conflict, and the source without which there is none.

    Sums of squared normalised innovations are distributed as chi-squared if covariances are right and errors normal, so
    the rate of false alarms is the requested one. Of two sources, nothing shows which is wrong.

    Args:
        sources: Means of every source over the same windows, by name.
        false_alarm: Rate of false alarms that is allowed.

    Returns:
        The conflict, if there is one.
    """
    everyone = disagreement(tuple(sources.values()))
    without = {name: disagreement([one for other, one in sources.items() if other != name]) for name in sources}
    alarmed = everyone.alarms(false_alarm)
    return Conflict(
        is_there=alarmed,
        everyone=everyone,
        without=without,
        suspects=tuple(name for name, rest in without.items() if alarmed and not rest.alarms(false_alarm)),
    )


FALSE_ALARM = 0.01
"""Rate of intervals, or of windows, that have a conflict though every covariance is right."""

WINDOW_S = 1.0
"""Length of the windows in which sources are compared: noise averages out, and motions are still seen; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fusion:
    """Joint torques of all sources together over one interval."""

    joints: tuple[str, ...]
    """Names of j joints."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    torque: FloatArray
    """Fused torques along +q, NaN where no source knows one; shape (n, j); N m, N where prismatic."""
    covariance: FloatArray
    """Their covariance; shape (n, j, j); (N m)^2. Where sources contradict each other and none alone explains that, it
    is larger by the mean of their squared normalised innovations."""
    used: tuple[str, ...]
    """Sources that were combined."""
    conflict: Conflict
    """Over the whole interval."""
    windows: tuple[Conflict, ...]
    """In each window by itself."""

    @property
    def half_width(self) -> FloatArray:
        """Half of the 95 % intervals; shape (n, j); N m."""
        return NORMAL_95 * np.sqrt(np.einsum("njj->nj", self.covariance))


def fuse(sources: Sequence[TorqueSource], *, false_alarm: float = FALSE_ALARM, window_s: float = WINDOW_S) -> Fusion:
    """Combine sources of joint torques by least squares weighted by their covariances.

    Errors of different sources are independent except for those that they share, such as those of the robot model:
    these stay whole, for any number of sources. How far two sources share them in truth depends on the links that
    each uses. Intervals take them as common to all, and the search for conflicts takes them as independent: each of the
    two is on the safe side. A source that alone contradicts the others over the interval is left out of all of it.

    Args:
        sources: Sources with the same joints and instants, at least one.
        false_alarm: Rate of false alarms of the test for conflicts, per interval and per window.
        window_s: Length of the windows in which means are compared; s.

    Returns:
        Torques with their covariance, and the conflicts.

    Raises:
        EstimationError: If names are not unique, joints or instants differ, or rate and window are none.
    """
    _require_comparable(sources)
    sources = _with_all_shared(sources)
    if not (0.0 < false_alarm < 1.0 and 0.0 < window_s < np.inf):
        raise EstimationError(
            f"fuse: expected 0 < false_alarm < 1 and a positive window_s, got {false_alarm} and {window_s} s"
        )
    compared = means_in_windows([source.independent for source in sources], window_s)
    means = dict(zip((source.name for source in sources), compared, strict=True))
    conflict = conflict_between(means, false_alarm)
    used = [source for source in sources if source.name != conflict.source]
    torque, covariance = combined(
        [source.torque for source in used],
        [source.own_covariance for source in used],
        [source.shared for source in used],
    )
    if conflict.is_there and conflict.source is None:
        covariance = covariance * max(1.0, conflict.everyone.total.ratio)
    first = sources[0]
    return Fusion(
        joints=first.joints,
        stamp_ns=first.stamp_ns,
        torque=torque,
        covariance=covariance,
        used=tuple(source.name for source in used),
        conflict=conflict,
        windows=tuple(
            conflict_between({name: one.window(k) for name, one in means.items()}, false_alarm)
            for k in range(len(means[first.name].torque))
        ),
    )


def _with_all_shared(sources: Sequence[TorqueSource]) -> list[TorqueSource]:
    """Give every source a column for each shared error, zero where it has none of them."""
    counts = {source.shared.shape[2] for source in sources} - {0}
    if len(counts) > 1:
        raise EstimationError(
            f"fuse: shared: expected the same errors in all sources that have any, got {sorted(counts)} of them"
        )
    shape = (*sources[0].torque.shape, max(counts, default=0))
    return [source if source.shared.shape == shape else replace(source, shared=np.zeros(shape)) for source in sources]


def _require_comparable(sources: Sequence[TorqueSource]) -> None:
    names = [source.name for source in sources]
    if not names or len(set(names)) < len(names):
        raise EstimationError(f"fuse: expected sources of different names, at least one, got {names}")
    first = sources[0]
    for other in sources[1:]:
        pair = f"sources {first.name!r} and {other.name!r}"
        if other.joints != first.joints:
            raise EstimationError(f"{pair}: expected the same joints, got {first.joints} and {other.joints}")
        if len(other) != len(first):
            raise EstimationError(
                f"{pair}: expected the same instants, got {len(first)} and {len(other)}; interpolate them before"
            )
        apart = np.abs(other.stamp_ns - first.stamp_ns)
        if apart.any():
            row = int(apart.argmax())
            raise EstimationError(
                f"{pair}, sample {row}: expected the same instants, they are {apart[row] * 1e-9:.6f} s apart; "
                "interpolate one to those of the other before"
            )
