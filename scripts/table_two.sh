#!/usr/bin/env bash
# Table II with a row for every method, beside the paper's figures.
# usage: table_two.sh BIN MODEL LIMIT FOLDER
# Without a MODEL: from the answers in examples/recorded, on the texts that they answer.
# With one: asks it on a sample of LIMIT texts, then once more from the recorded replies,
# which must give the same table. OPTIONS takes further options of the model, such as
# "--base-url URL --price 0.15,0.60".
set -euo pipefail
bin=$1
model=$2
limit=$3
folder=$4
recorded=examples/recorded
round=recorded
names=()

run() { # NAME AGENT OPTION…: run a method, resuming what is there
    local name=$1 agent=$2
    shift 2
    names+=("$name")
    "$bin/memorymaze" evaluate --agent "$agent" --out "$folder/$round/$name" --resume "$@"
}

texts_answered_in() { # FILE OUT: the shipped instructions that a file of answers is about
    "$bin/python" scripts/texts_answered.py "$1" "$2"
}

tables() { # all there is to say of the runs of this round; the first one is the baseline
    local runs=("${names[@]/#/$folder/$round/}")
    "$bin/memorymaze" table "${runs[@]}" --table II "${absent[@]}"
    "$bin/memorymaze" compare "${runs[@]}"
    "$bin/memorymaze" table "${runs[@]}" --table reach
}

if [ -z "$model" ]; then
    mkdir -p "$folder/$round"
    all=$folder/texts.jsonl few=$folder/texts_navgpt.jsonl
    texts_answered_in $recorded/programs_without_parser.jsonl "$all"
    texts_answered_in $recorded/navgpt.jsonl "$few"
    plans=(--set reader=model --replay $recorded/plans.jsonl)
    run rules rules --instructions "$all"
    run rules_plans rules --instructions "$all" "${plans[@]}"
    run guide guide --instructions "$all"
    run guide_plans guide --instructions "$all" "${plans[@]}"
    run explorer explorer --instructions "$all"
    run code_generation code_generation --instructions "$all" \
        --replay $recorded/programs_without_parser.jsonl
    run code_generation_parser code_generation --instructions "$all" \
        --replay $recorded/programs_with_parser.jsonl
    run navgpt navgpt --instructions "$few" --replay $recorded/navgpt.jsonl
    run oracle oracle --instructions "$all"
    run stop stop --instructions "$all"
    how='--model NAME --record replies.jsonl asks a model, --replay replies.jsonl plays it again'
    absent=(
        --absent "navid=memorymaze evaluate --agent navid $how (a vision model)"
        --absent "see_and_go=memorymaze evaluate --agent see_and_go $how (a vision model)"
        --absent "code_generation, single stage=memorymaze evaluate --agent code_generation --set stages=single $how"
        --absent "code_generation with repair=memorymaze evaluate --agent code_generation --set repair=true $how"
    )
    tables
    exit
fi

replies=$folder/replies.jsonl
case $model in
smollm2 | gguf:*)
    "$bin/python" -c 'import llama_cpp' 2>/dev/null || "$bin/python" -m pip install --quiet \
        --disable-pip-version-check --constraint constraints.txt --editable '.[local-llm]'
    # A small model in bounded time: it sees no pictures, and reads little at once.
    code_generation=(--set max_tokens=400)
    navgpt=(--set budget=released --set iterations=4 --set scratchpad=3000 --set max_tokens=120)
    navid=(--set pictures=none --set max_steps=30 --set max_tokens=60)
    absent=(--absent "see_and_go=needs a model that sees pictures: make table-two MODEL=NAME")
    ;;
*)
    code_generation=()
    navgpt=()
    navid=()
    absent=()
    ;;
esac
read -ra options <<<"${OPTIONS:-}"

for round in asked replayed; do
    names=()
    ask=(--model "$model" --limit "$limit")
    if [ "$round" = asked ]; then
        ask+=(--record "$replies" "${options[@]}")
    else
        ask+=(--replay "$replies")
    fi
    run rules rules --limit "$limit"
    run rules_plans rules --set reader=model "${ask[@]}"
    run guide guide --limit "$limit"
    run guide_plans guide --set reader=model "${ask[@]}"
    run explorer explorer --limit "$limit"
    run code_generation code_generation --set parser=false "${code_generation[@]}" "${ask[@]}"
    run code_generation_parser code_generation "${code_generation[@]}" "${ask[@]}"
    run navgpt navgpt "${navgpt[@]}" "${ask[@]}"
    run navid navid "${navid[@]}" "${ask[@]}"
    [ ${#absent[@]} -gt 0 ] || run see_and_go see_and_go "${ask[@]}"
    "$bin/memorymaze" table "$folder/$round"/*/ --format csv --out "$folder/$round.csv"
done
round=asked
tables
if cmp --silent "$folder/asked.csv" "$folder/replayed.csv"; then
    echo "replayed from $replies: the same table"
else
    echo "replayed from $replies: ANOTHER TABLE, compare $folder/asked.csv and replayed.csv" >&2
    exit 1
fi
