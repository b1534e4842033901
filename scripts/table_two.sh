#!/usr/bin/env bash
# Table II with a row for every method: NavGPT, the NaVid protocol, code generation
# without and with the parser, and rules; all on the same sample, then once more from
# the recorded replies, which must give the same table.
# usage: table_two.sh BIN MODEL LIMIT FOLDER
# OPTIONS takes further options of the model, such as "--base-url URL --price 0.15,0.60".
set -euo pipefail
bin=$1
model=$2
limit=$3
folder=$4
read -ra options <<<"${OPTIONS:-}"
replies=$folder/replies.sqlite

case $model in
smollm2 | gguf:*)
    "$bin/python" -c 'import llama_cpp' 2>/dev/null || "$bin/python" -m pip install --quiet \
        --disable-pip-version-check --constraint constraints.txt --editable '.[local-llm]'
    # A small model in bounded time: it sees no pictures, and reads little at once.
    code_generation=(--set max_tokens=400)
    navgpt=(--set budget=released --set iterations=4 --set scratchpad=3000 --set max_tokens=120)
    navid=(--set pictures=none --set max_steps=30 --set max_tokens=60)
    ;;
*)
    code_generation=()
    navgpt=()
    navid=()
    ;;
esac

run() { # NAME AGENT OPTION…: run a method, resuming what is there
    local name=$1 agent=$2
    shift 2
    "$bin/memorymaze" evaluate --agent "$agent" --limit "$limit" --out "$folder/$round/$name" \
        --resume "$@"
}

for round in asked replayed; do
    ask=(--model "$model")
    if [ "$round" = asked ]; then
        ask+=(--record "$replies" "${options[@]}")
    else
        ask+=(--replay "$replies")
    fi
    run rules rules
    run code_generation code_generation --no-parser "${code_generation[@]}" "${ask[@]}"
    run code_generation_parser code_generation "${code_generation[@]}" "${ask[@]}"
    run navgpt navgpt "${navgpt[@]}" "${ask[@]}"
    run navid navid "${navid[@]}" "${ask[@]}"
    "$bin/memorymaze" table "$folder/$round"/*/ --format csv --out "$folder/$round.csv"
done
"$bin/memorymaze" table "$folder"/asked/*/ --table II
if cmp --silent "$folder/asked.csv" "$folder/replayed.csv"; then
    echo "replayed from $replies: the same table"
else
    echo "replayed from $replies: ANOTHER TABLE, compare $folder/asked.csv and replayed.csv" >&2
    exit 1
fi
