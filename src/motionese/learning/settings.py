"""Settings of training and of recognition: typed, checked where they are read."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.faults import first_fault, refusal

Optimiser = Literal["descent", "momentum", "adam"]
Schedule = Literal["constant", "cosine"]
ErrorName = Literal["squared", "gaussian"]
Learned = Literal["weights", "bias", "tau", "variance", "initial_states"]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
ByLevel = dict[str, NotNegative]
Bound = NotNegative | ByLevel
"""One limit for all context levels, or limits by level; a level that is not named is free."""
Rate = Annotated[float, Field(ge=0, le=100)]


class _InASentence(type(BaseModel)):  # type: ignore[misc]
    """What settings are made by: a wrong one is refused in one sentence."""

    def __call__(cls, *args: Any, **given: Any) -> Any:
        try:
            return super().__call__(*args, **given)
        except ValidationError as error:
            raise refusal(first_fault(error, given), cls.model_fields) from error


class Training(BaseModel, metaclass=_InASentence):
    """How weights and initial states are trained (equations (3)–(5)).

    The defaults suit recordings of any length and number; the imitation loop has a regime of its
    own, in `experiment/presets/`.

    Attributes:
        epochs: How often every motion is learned from.
        batch: Motions in one update at most; 0 for all. They are shuffled every epoch, and dealt
            evenly to as few updates as need be. Many motions are learned in fewer epochs so.
        learned: What is learned, of what the network has; see `learning.parameters`. With "tau"
            the time constants as well, one factor a level.
        error: Squared (equation (3)), or Gaussian: the negative log likelihood with the variance
            that the network predicts, for one drawn with `variance=True`.
        optimiser: Plain gradient descent (the paper), with momentum, or Adam.
        weight_rate: α of equation (4), for the weights, the bias and what else the network has.
        initial_rate: β of equation (5), for every motion's own initial states.
        schedule: Rates that stay, or that rise over the first 5 % of all updates and then fall
            along half a cosine to a hundredth.
        momentum: Of `optimiser = "momentum"`.
        clip: Largest joint norm of the gradient of all that is learned; 0 for none. With Adam it
            holds back the few epochs in which gradients explode: without it, rates must be ten
            times smaller.
        teacher_forcing: Share of the sensed value in an input, the rest being the network's own
            prediction: 1 teacher forcing, 0 closed loop.
        bound: Largest |u_0| of the initial states after every update, for all context levels or
            by level. Large ones that decay are used as timers and run out.
        noise: Standard deviation of the noise on a level's potentials at every step; none if not
            named.
        patience: Stop when the loss, of the held-out motions where there are any, has fallen by
            less than `tolerance` over so many epochs, and keep what was best for the held-out
            ones; 0 to train through all epochs.
        tolerance: See `patience`; a share of the loss.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    epochs: int = Field(default=3000, ge=1)
    batch: int = Field(default=0, ge=0)
    learned: tuple[Learned, ...] = Field(
        default=("weights", "bias", "variance", "initial_states"), min_length=1
    )
    error: ErrorName = "squared"
    optimiser: Optimiser = "adam"
    weight_rate: Rate = 0.05
    initial_rate: Rate = 0.3
    schedule: Schedule = "cosine"
    momentum: float = Field(default=0.9, ge=0, lt=1)
    clip: float = Field(default=1.0, ge=0)
    teacher_forcing: float = Field(default=0.05, ge=0, le=1)
    bound: Bound = 5.0
    noise: ByLevel = {}
    patience: int = Field(default=0, ge=0)
    tolerance: float = Field(default=1e-3, ge=0, lt=1)


class Recognition(BaseModel, metaclass=_InASentence):
    """How the initial states of an observed motion are found, the weights frozen.

    Attributes:
        iterations: Steps at most.
        recalled: Starts that are recalled: of all that was learned, what is nearest to what is
            observed, so many at most.
        starts: Random starts beside those that are recalled or given.
        spread: Standard deviation of the random starts.
        optimiser: Least squares (damped Gauss–Newton steps), plain gradient descent, with momentum,
            or Adam; the last three need some hundred iterations.
        levels: Context levels whose initial states are sought, the others being held at those of
            the first start; all if left out.
        still: Least squares ends where a step makes the loss smaller by less than this share: to
            go on is to fit noise.
        rate: Rate of gradient descent, times 0.3 after 70 % of the iterations.
        momentum: Of `optimiser = "momentum"`.
        slower: By level: at which share of the others' pace its initial states move, so that a
            change is first sought in the others.
        bound: Largest |u_0| of the initial states, for all context levels or by level.
        penalty: Weight of Σ u_0² beside the summed squared error; a prior at 0.
        tolerance: Largest residual of a channel, as a share of its range, that still counts as
            recognised.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    iterations: int = Field(default=100, ge=1)
    recalled: int = Field(default=4, ge=1)
    starts: int = Field(default=3, ge=0)
    spread: float = Field(default=0.5, ge=0)
    optimiser: Optimiser | Literal["least_squares"] = "least_squares"
    levels: tuple[str, ...] | None = Field(default=None, min_length=1)
    still: float = Field(default=1e-4, ge=0, lt=1)
    rate: Rate = 0.2
    momentum: float = Field(default=0.9, ge=0, lt=1)
    slower: dict[str, Annotated[float, Field(gt=0, le=1)]] = {}
    bound: Bound = 100.0
    penalty: float = Field(default=0.0, ge=0)
    tolerance: float = Field(default=0.1, gt=0)
