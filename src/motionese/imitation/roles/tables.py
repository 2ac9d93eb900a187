"""All tables on the roles of a network's levels, from fresh demonstrations of a lesson."""

from collections.abc import Iterator, Sequence

from motionese.imitation.learner import Learner
from motionese.imitation.loop import Row
from motionese.imitation.roles.boundaries import boundaries_found
from motionese.imitation.roles.decoders import decoded
from motionese.imitation.roles.exchange import exchanged
from motionese.imitation.roles.lesions import lesioned
from motionese.imitation.roles.recognised import recognised
from motionese.imitation.roles.symbols import readings, symbols_read
from motionese.imitation.scene import Scene
from motionese.learning import Recognition
from motionese.task import PrimitiveSequence


def role_tables(
    scene: Scene, learner: Learner, lesson: Sequence[PrimitiveSequence]
) -> dict[str, list[Row]]:
    """Return exchanges, lesions, decoding, symbols and boundaries.

    The demonstrations are recognised from the repertoire; for exchanges also by Adam where its
    iterations are set, with all levels at one pace, and with the fastest context level slower.
    """
    settings = scene.settings.evaluation
    many = settings.roles.demonstrations
    shown = recognised(scene, learner, lesson, settings.repertoire, many)
    alone = recognised(scene, learner, scene.task.sequences(1), settings.repertoire, many)
    read = readings(shown, alone, shown)
    exchanges = [{"recognition": "least squares", **row} for row in exchanged(shown)]
    for name, control in _controls(scene, learner):
        by_descent = exchanged(recognised(scene, learner, lesson, control, many))
        exchanges += [{"recognition": name, **row} for row in by_descent]
    return {
        "exchanges.csv": exchanges,
        "lesions.csv": lesioned(shown),
        "decoding.csv": decoded(shown),
        "symbols.csv": symbols_read(read),
        "boundaries.csv": boundaries_found(shown, read, scene.body.rate_hz),
    }


def _controls(scene: Scene, learner: Learner) -> Iterator[tuple[str, Recognition]]:
    roles = scene.settings.evaluation.roles
    if roles.adam:
        update = {"optimiser": "adam", "iterations": roles.adam, "starts": 0, "slower": {}}
        adam = scene.settings.evaluation.recognition.model_copy(update=update)
        fastest = learner.network.names[1]
        yield "Adam", adam
        slower = {fastest: roles.pace}
        yield f"Adam, {fastest} slower", adam.model_copy(update={"slower": slower})
