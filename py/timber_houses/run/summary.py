# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of the run that is loaded in YADE: summary.json, history.csv, breaks.csv, and the tables of quantities.py."""
import math
from dataclasses import replace

import yade.wrapper as yw
from yade_timber.energy_terms import DISSIPATED, ELASTIC, IMPOSED
from yade_timber.plugin import compiled
from yade_timber.scene import queries
from yade_timber.scene.engines import find_engine

from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.json_types import decode, encode
from ..base.table import csv_text
from ..house import comparison, diagnose, weigh
from ..recording import drift
from ..recording.history import BREAKS
from ..recording.history import NAME as HISTORY
from ..recording.summary import NAME, Summary
from ..recording.summary_parts import ColumnDrifts, Diagnosis, Energy, Solver, Versions, Walls, Weight
from ..text.english import sentence
from . import observer, quantities

CREATED, NEGLIGIBLE = 1e-4, 1e-3
"""Admissible energy created by contacts and joints, as a share of the input [-], and what is always admissible [J]."""
NAMES = (NAME, HISTORY, BREAKS, *quantities.NAMES)  # files that `write` makes
O = yw.Omega()


def summary(scenario, observed, histories, tables, wall_s, made_from, cut_off=None):
    """Summary of the scene as it is now. histories: {structure: History}, the main one first; tables:
    quantities.Tables; wall_s [s]; cut_off: reason for an early end.

    Drifts: recording/drift.py; broken, columns: recording/damage.py. Raises RunError for energies that are not finite.
    """
    model, survey, state = observed.model, observed.survey, observed.state()
    skipper, main = find_engine(yw.RestSkipper), observed.judge.main
    history, ends = next(iter(histories.values())), {name: drift.residual(one) for name, one in histories.items()}
    residual, amplitude = next(iter(ends.values()))
    simulated = round(O.iter * scenario.dt, 9)
    structures = {name: replace(facts, residual_drift=max(ends[name][0], default=0.0),  # means over the last periods
                                settled=drift.has_settled(*ends[name]))
                  for name, facts in survey.by_structure(state, observed.judge.structures).items()}
    created = compiled.created_energy()
    energy = (energy_balance(queries.energy(), created) if cut_off is None
              else energy_balance({name: float(history.energy(name)[-1]) if history.samples else 0.0
                                   for name in compiled.energy()}, created if math.isfinite(created) else None))
    draft = Summary(
        scenario=scenario.name, lot=scenario.lot, model=model.name,
        description=model.description,
        earthquake=scenario.motion is not None, snow=model.snow_depth > 0,
        snow_depth_m=model.snow_depth, snow_mass_kg=model.counts()["mass_snow"], weight=decode(Weight, weigh(model)),
        diagnosis=decode(Diagnosis, {**diagnose(model), "disagreement": ""}), joint_damping=scenario.joint_damping,
        walls=Walls(level=model.law["wall_level"], other=scenario.other_walls) if model.law["wall_level"] else None,
        record=scenario.record, dt=scenario.dt, duration_s=simulated, until_collapse=scenario.until_collapse,
        cut_off=cut_off or created_too_much(energy), steps=O.iter, wall_s=round(wall_s, 3),
        skipped_s=round(skipper.skipped if skipper else 0.0, 3),
        real_time_factor=round(simulated / wall_s, 6) if wall_s > 0 else None, threads=compiled.thread_count(),
        elements=len(O.bodies), joints=survey.count_all(),
        broken=survey.count_broken(state, len(find_engine(yw.JointEngine).breaks)), columns=survey.count_columns(state),
        leans_from_s=drift.lean_start(history, main.tilt_s, main.tilt_direction), tilt_time_s=main.tilt_s,
        tilt_direction=main.tilt_direction, collapsed=main.fall_s is not None, collapse_time_s=main.fall_s,
        fallen_structures=[name for name, facts in structures.items() if facts.collapsed],
        leaning_structures=[name for name, facts in list(structures.items())[1:] if facts.leans],
        peak_drift=drift.by_storey(main.peak), residual_drift=drift.by_storey(residual),
        final_amplitude=drift.by_storey(amplitude), still_moving=drift.still_moving(amplitude),
        events=observed.log.sorted(), energy=energy, solver=solver(), versions=Versions(**observer.versions()),
        structures=structures, quantities=quantities.summarised(tables, observed), verdict="", sentence="",
        made_from=made_from,
        rest_s=observed.at_rest if scenario.until_rest and observed.is_over else None,
        column_drift=ColumnDrifts(drift.by_storey(main.column_peak), drift.by_storey(main.median_peak)),
    )
    return judged(draft)


def judged(draft):
    """The Summary with verdict and sentences. No drift is a residual one before the strong shaking is over."""
    structures = {name: replace(facts, settled=facts.settled and draft.missed_shaking is None)
                  for name, facts in draft.structures.items()}
    draft = replace(draft, structures=structures, verdict=next(iter(structures.values())).verdict)
    return replace(draft, diagnosis=replace(draft.diagnosis, disagreement=comparison(draft)), sentence=sentence(draft))


def energy_balance(terms, created):
    """The part `energy` [J] from the terms of `queries.energy`. created: `compiled.created_energy()`, None if unknown

    input: work of the ground motion, energy of imposed velocities and potential energy released by gravity since the
    start. residual: stored, kinetic and dissipated energy minus the input; residual_fraction: its absolute value over
    the input, None without input. created: energy that contact points and joints returned beyond what they had stored;
    contained in `residual`. Raises RunError for numbers that are not finite."""
    terms = {"ground_motion": 0.0, IMPOSED: 0.0, **dict.fromkeys(DISSIPATED, 0.0), **terms}
    supplied = terms["ground_motion"] + terms[IMPOSED] - terms["gravity"]
    residual = queries.energy_residual(terms)
    balance = Energy(input=supplied, kinetic=terms["kinetic"], elastic=sum(terms[name] for name in ELASTIC),
                     dissipated={name: terms[name] for name in DISSIPATED},
                     created=created, residual=residual,
                     residual_fraction=abs(residual) / supplied if supplied > 0 else None,
                     ground_motion=terms["ground_motion"], gravity_released=-terms["gravity"])
    if not all(math.isfinite(value) for value in (supplied, residual, created or 0.0, *balance.dissipated.values())):
        raise RunError(f"the energies at {O.time:.4f} s are not finite: {encode(balance)}; try a smaller --dt")
    return balance


def solver():
    """The part `solver`: sweeps of a computed step, mean and largest; steps that ended before their sweeps had
    converged, and the largest change of a pair in the last sweep of one, as twice its kinetic energy [J]; the
    largest overlap that no contact carried [m]."""
    forces, skipper = find_engine(yw.ContactForces), find_engine(yw.RestSkipper)
    check = find_engine(yw.OverlapCheck)
    computed = O.iter - (round(skipper.skipped / O.dt) if skipper else 0)
    mean = round(forces.sweepsDone / max(1, computed), 3)
    return Solver(sweeps_mean=mean, sweeps_max=forces.sweepsMax, unconverged_steps=forces.unconverged,
                  worst_change_j=forces.worstChange, uncarried_overlap_m=check.largest if check else None)


def created_too_much(energy):
    """Sentence on energy that contacts and joints have created beyond CREATED of the input; None without."""
    if energy.created <= CREATED * max(energy.input, 0.0) or energy.created < NEGLIGIBLE:
        return None
    share = energy.created / energy.input if energy.input > 0 else math.inf
    return (f"contacts and joints have created {energy.created:.3g} J, {share:.1g} of the energy put in (admissible:"
            f" {CREATED:g}); try a smaller --dt")


BREAKS_HEADER = ("time [s]", "joint", "kind", "storey", "side", "spring", "cause", "force [N]")


def write(folder, result, history, tables, model):
    """Write all files, the summary last: where it is, the others are complete. Returns paths. Raises OSError."""
    paths, breaks = tables.write(folder), find_engine(yw.JointEngine).breaks
    broken = csv_text(BREAKS_HEADER, (observer.break_row(entry, model) for entry in breaks))
    for name, text in ((HISTORY, history.text()), (BREAKS, broken)):
        write_text(folder / name, text)
        paths.append(folder / name)
    return [*paths, result.write(folder)]
