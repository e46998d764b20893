//! `summary.json` of a study.

use outcome::{Judged, Spread};
use run::study::Study;
use run::study::answer::{Answer, Sensitivity};
use run::study::estimate::Estimate;
use run::study::selection::Candidate;
use run::study::table::{Table, warned};
use serde_json::{Map, Value, json};

/// The summary as text.
pub(super) fn json(study: &Study, table: &Table, answer: &Answer, complete: bool) -> String {
    let quantities: Map<String, Value> = (answer.spreads.iter())
        .map(|(name, unit, spread)| (name.clone(), quantity(unit, spread.as_ref())))
        .collect();
    let limits: Vec<Value> = answer.limits.iter().map(limit).collect();
    let sensitivity: Map<String, Value> = (answer.sensitivity.iter())
        .map(|(name, _, of)| (name.clone(), sensitivities(study, of)))
        .collect();
    let failed: Vec<Value> = (table.failed.iter())
        .map(|(member, why)| json!({"member": member, "why": why, "drawn": drawn(study, *member)}))
        .collect();
    let inputs: Vec<Value> = (study.file.inputs.iter())
        .map(|input| {
            json!({"path": input.vary.path, "distribution": input.vary.distribution_toml(), "unit": input.vary.unit()})
        })
        .collect();
    let warnings: Vec<Value> = (warned(table).iter())
        .map(|warned| {
            json!({"code": warned.code, "title": warned.title, "members": warned.members, "first_member": warned.first})
        })
        .collect();
    let mut all = json!({
        "format": "auxbear.study_summary/1",
        "version": env!("CARGO_PKG_VERSION"),
        "complete": complete,
        "title": study.file.title,
        "seed": study.file.seed,
        "design": study.file.kind,
        "members": answer.members,
        "members_asked": answer.asked,
        "members_failed": table.failed.len(),
        "inputs": inputs,
        "warnings": warnings,
        "limits": limits,
        "ranking": answer.ranking.iter().map(candidate).collect::<Vec<_>>(),
        "ranked_by": study.file.rank.as_ref().map(|(name, most, _)| json!({"quantity": name, "best": if *most { "most" } else { "least" }})),
        "quantities": quantities,
        "sensitivity": sensitivity,
        "failed": failed,
    });
    if let Some(estimate) = &answer.estimate {
        all["estimate"] = estimated(estimate);
    }
    format!("{all:#}\n")
}

fn estimated(estimate: &Result<Estimate, String>) -> Value {
    let found = match estimate {
        Ok(found) => found,
        Err(why) => return json!({"inputs": null, "why": why}),
    };
    let inputs: Vec<Value> = (found.inputs.iter().zip(&found.correlation))
        .map(|(own, correlation)| {
            json!({"path": own.path, "unit": own.unit, "value": own.value, "standard_uncertainty": own.uncertainty, "bounds": own.bounds,
                "correlation": correlation, "determined": own.why.is_empty(), "why": own.why, "set": values_json(&own.set)})
        })
        .collect();
    json!({"inputs": inputs, "misfit": found.misfit, "rows": found.rows[0], "independent_rows": found.rows[1], "runs": found.runs,
        "member_as_good_elsewhere": found.rival})
}

fn quantity(unit: &str, spread: Option<&Spread>) -> Value {
    match spread {
        None => json!({"value": null, "unit": unit, "why": "fewer than two members have it"}),
        Some(spread) => json!({
            "value": spread.mean,
            "unit": unit,
            "members": spread.members,
            "mean": spread.mean,
            "standard_deviation": spread.standard_deviation,
            "smallest": spread.smallest,
            "largest": spread.largest,
            "quantiles": {"0.05": spread.quantiles[0], "0.5": spread.quantiles[1], "0.95": spread.quantiles[2]},
        }),
    }
}

/// Paths with their values.
pub(super) fn values_json(values: &[(String, String)]) -> Map<String, Value> {
    let all = values.iter();
    all.map(|(path, value)| (path.clone(), Value::String(value.clone())))
        .collect()
}

fn candidate(one: &Candidate) -> Value {
    json!({
        "candidate": values_json(&one.values),
        "verdict": one.verdict.word(),
        "quantile_95_percent": one.quantile,
        "mean": one.mean,
        "first_in_share_of_repetitions": one.first,
        "first_member": one.member,
        "draws": one.draws[0],
        "draws_failed": one.draws[1],
        "failed_why": one.why,
        "open_why": one.open,
        "limits": one.limits.iter().zip(&one.worst).map(of_case).collect::<Vec<_>>(),
    })
}

fn of_case((limit, worst): (&Judged, &Option<usize>)) -> Value {
    let mut all = judged(limit);
    all["worst_member"] = json!(worst);
    all
}

fn limit(limit: &run::study::answer::StudyLimit) -> Value {
    let mut all = judged(&limit.judged);
    all["share_beyond"] = json!(
        limit
            .beyond
            .map(|(value, band)| json!({"value": value, "band_95_percent": band}))
    );
    all
}

fn judged(judged: &Judged) -> Value {
    json!({
        "quantity": judged.limit.quantity,
        "side": judged.limit.side.word(),
        "bound": judged.limit.bound,
        "share": judged.limit.share,
        "value": judged.value,
        "unit": judged.unit,
        "members": judged.members,
        "hold": judged.hold,
        "verdict": judged.verdict.word(),
        "why": judged.why,
    })
}

fn sensitivities(study: &Study, of: &Sensitivity) -> Value {
    let paths = study
        .file
        .inputs
        .iter()
        .map(|input| input.vary.path.as_str());
    let rows: Vec<Value> = match of {
        Sensitivity::Sweep(given, ranges) => (paths.zip(ranges))
            .map(|(path, range)| json!({"input": path, "given": given, "range": range}))
            .collect(),
        Sensitivity::Effects(effects) => (paths.zip(effects))
            .map(|(path, effect)| match effect {
                Some(effect) => {
                    json!({"input": path, "mean_size": effect.mean_size, "mean": effect.mean,
                    "standard_deviation": effect.deviation, "effects": effect.count})
                }
                None => json!({"input": path, "mean_size": null, "why": "fewer than two effects"}),
            })
            .collect(),
        Sensitivity::Indices(indices) => (paths.zip(indices))
            .map(|(path, index)| {
                json!({"input": path,
                    "first": {"value": index.first.value, "band_95_percent": index.first.band},
                    "total": {"value": index.total.value, "band_95_percent": index.total.band}})
            })
            .collect(),
    };
    Value::Array(rows)
}

/// What a member drew, as an override has it.
fn drawn(study: &Study, member: usize) -> Map<String, Value> {
    values_json(&study.drawn(member).values)
}
